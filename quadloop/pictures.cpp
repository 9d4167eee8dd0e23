#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "flow/euler/model/euler_options.hpp"
#include "flow/postprocess/flow_quantities.hpp"
#include "flow/postprocess/run_constants.hpp"
#include "io/files/output_file.hpp"
#include "io/plot/mesh_plot.hpp"
#include "mesher/mesh/variable_names.hpp"
#include "quadloop/quadloop.hpp"
#include "quadloop/require_input.hpp"

namespace quadloop {

namespace {

/// Computes Mach number or pressure coefficient if the solution lacks them.
void add_quantity(Field& solution, const std::string& name) {
  if (std::ranges::find(flow::quantity_names(), name) == flow::quantity_names().end()) return;
  if (std::ranges::find(solution.names, name) != solution.names.end()) return;
  for (const char* variable : flow::euler_names) {
    if (variables_like(solution.names, variable).size() != 1) return;
  }
  flow::FreeStream stream;
  if (name == flow::pressure_coefficient_name) {
    const std::optional<flow::RunConstants> run = flow::RunConstants::of(solution.constants);
    if (!run) return;
    stream.speed = run->mach;
  }
  solution = flow::with_quantities(solution, {name}, stream);
}

/// The mesh and its blocks as the reader of a file gives them.
io::LoadedMesh as_loaded(Mesh mesh) {
  io::LoadedMesh loaded;
  MeshBlocks& blocks = mesh.blocks;
  if (blocks.of_triangles.empty() && blocks.of_quads.empty()) {
    blocks.of_triangles.assign(mesh.triangles.size(), 0);
    blocks.of_quads.assign(mesh.quads.size(), 0);
  }
  loaded.blocks = std::max(1, size32(blocks.names));
  loaded.block_names = std::move(blocks.names);
  loaded.triangle_to_block = std::move(blocks.of_triangles);
  loaded.quad_to_block = std::move(blocks.of_quads);
  loaded.mesh = std::move(mesh);
  return loaded;
}

}  // namespace

std::string picture(const Communicator& comm, Mesh mesh, Field solution, const PlotOptions& options,
                    PlotFormat format) {
  require_rows(comm, mesh, solution);
  io::LoadedMesh loaded = as_loaded(std::move(mesh));
  add_quantity(solution, options.field);
  if (!solution.empty()) loaded.solution = std::move(solution);
  return io::draw_mesh(comm, loaded, options, format);
}

void plot(const Communicator& comm, Mesh mesh, const std::string& path, Field solution,
          const PlotOptions& options) {
  const PlotFormat format = io::plot_format_of(path);
  io::OutputSet outputs(comm);
  const io::StagedFile staged = outputs.stage(path);
  const std::string bytes = picture(comm, std::move(mesh), std::move(solution), options, format);
  comm.together([&] {
    if (!comm.is_root()) return;
    io::OutputFile file(staged);
    file.write(bytes);
    file.close();
  });
  outputs.commit();
}

}  // namespace quadloop
