// Layers of random heights at walls of random loops, and along a free line: no column meets another, and the
// outline outside the layers is one that can be meshed.
#include <algorithm>
#include <cmath>
#include <vector>

#include "generate/outside_layers.hpp"
#include "mesher/base/error.hpp"
#include "mesher/delaunay/flipper.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/layers_from.hpp"
#include "tests/fuzz/outlines.hpp"

namespace quadloop::fuzz {

namespace {

/// The strip between the wall and the front from each station to the next one.
void require_positive(const LayerFront& front) {
  const WallLine& line = front.line;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    if (!line.goes_on(i)) continue;
    const std::int32_t j = line.next(i);
    const Point a = line[i].wall, b = line[j].wall, c = front.points[j], d = front.points[i];
    QUADLOOP_REQUIRE(is_positive(a, c, d), "columns of layers meet");
    if (a != b) QUADLOOP_REQUIRE(is_positive(a, b, c), "a column of layers leans through the wall");
  }
}

double area_of(const Geometry& geometry) {
  double area = 0;
  for (std::int32_t v = 0; v < geometry.size(); ++v)
    area += 0.5 * cross(geometry.point(v), geometry.point(geometry.next(v)));
  return area;
}

/// What assemble() refuses of an outline of ours is a mistake of ours.
void require_outline(const Geometry& outer, double area_of_domain) {
  Warnings warnings;
  AssembleOptions options;
  options.domain_is_known = true;
  try {
    const Geometry again = assemble(chains_of(outer), options, warnings);
    QUADLOOP_REQUIRE(std::abs(area_of(again) - area_of(outer)) < 1e-9, "a front has the domain to its right");
  } catch (const InputError& fault) {
    QUADLOOP_REQUIRE(false, fault.what());
  }
  QUADLOOP_REQUIRE(area_of(outer) > 0 && area_of(outer) < area_of_domain,
                   "layers take no part of the domain");
}

}  // namespace

int layer_fronts(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const AssembleOptions options = walls_with_layers(bytes);
  const std::vector<LayerLine> lines = lines_from(bytes);
  const std::optional<double> curvature =
      bytes.below(3) == 0 ? std::optional(1.0 + bytes.below(60)) : std::nullopt;
  Warnings warnings;
  MeshInput input{assemble(loops_from(bytes), options, warnings), {}, {}};
  input.mesh.size.curvature = curvature;
  input.mesh.limit.cells = 20000;
  input.lines = lines;
  const LayerFront front = front_of(Communicator(MPI_COMM_SELF), input, input.geometry, {}, {});
  require_positive(front);
  require_outline(front.outer, area_of(input.geometry));
  return 0;
}

}  // namespace quadloop::fuzz
