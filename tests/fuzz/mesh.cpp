// A whole mesh of random loops with random settings on one rank: it is valid and that of its geometry, or
// refused.
#include <cmath>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/layers_from.hpp"
#include "tests/fuzz/outlines.hpp"

namespace quadloop::fuzz {

namespace {

SizeOptions sizes_from(Bytes& bytes) {
  SizeOptions sizes;
  const double mantissa = 1 + bytes.below(4) / 4.0;
  sizes.min = std::ldexp(mantissa, -3 - bytes.below(4));
  sizes.max = sizes.min * (1 + bytes.below(16));
  sizes.gradation = 1 + (1 + bytes.below(8)) / 8.0;
  if (bytes.below(4) == 0) sizes.curvature = 1.0 + bytes.below(90);
  if (bytes.below(4) == 0) sizes.gap = 1.0 + bytes.below(8);
  if (bytes.below(2) == 0) sizes.root = RootOptions{{-4, -4}, 3.0 + bytes.below(3), 3, 3};
  if (bytes.below(4) == 0) {
    const Point centre{(bytes.below(33) - 8) / 16.0, (bytes.below(33) - 8) / 16.0};
    sizes.sources.push_back({SizeSource::Disc{centre, bytes.below(8) / 16.0}, sizes.min});
  }
  return sizes;
}

MeshOptions mesh_options_from(Bytes& bytes) {
  MeshOptions options;
  options.size = sizes_from(bytes);
  options.type = bytes.below(2) == 0 ? MeshType::hybrid : MeshType::delaunay;
  options.quads = bytes.below(4) == 0 ? QuadChoice::parallel : QuadChoice::all;
  options.snap = bytes.below(5) / 10.0;
  options.may_vanish = bytes.below(2) == 0;
  options.limit.cells = 20000;
  return options;
}

/// Moved by tenths, so that rounding parts corners from the grid lines that they lie on.
std::vector<Chain> moved_loops_from(Bytes& bytes) {
  std::vector<Chain> chains = loops_from(bytes);
  const double x = bytes.below(8) / 10.0, y = bytes.below(8) / 10.0;
  for (Chain& chain : chains) {
    for (Point& p : chain.points) p = p + Point{x, y};
  }
  return chains;
}

MeshInput input_from(Bytes& bytes) {
  const MeshOptions options = mesh_options_from(bytes);
  smoother::SmoothOptions smooth;
  smooth.sweeps = bytes.below(4);
  smooth.objective = bytes.below(2) == 0 ? smoother::Objective::power : smoother::Objective::thesis;
  smooth.level_transitions = bytes.below(2) == 0;
  AssembleOptions outline;
  outline.domain_is_known = true;
  std::vector<LayerLine> lines;
  if (bytes.below(3) == 0) {
    outline = walls_with_layers(bytes);
    lines = lines_from(bytes);
  }
  Warnings warnings;
  MeshInput input{assemble(moved_loops_from(bytes), outline, warnings), options, smooth};
  input.lines = lines;
  return input;
}

}  // namespace

int small_mesh(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const MeshInput input = input_from(bytes);
  Mesh mesh = generate_mesh(Communicator(MPI_COMM_SELF), input).result.mesh;
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& b) { return b.edges.empty(); });
  for (const MeshFault& fault : validate(mesh)) {
    const std::string what = std::string(name_of(fault.rule)) + ": " + fault.what;
    QUADLOOP_REQUIRE(false, what.c_str());
  }
  for (const MeshFault& fault : validate_geometry(mesh, chains_of(input.geometry)).faults) {
    const std::string what = "the mesh is not of its geometry: " + fault.what;
    QUADLOOP_REQUIRE(false, what.c_str());
  }
  return 0;
}

}  // namespace quadloop::fuzz
