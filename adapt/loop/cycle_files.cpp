#include "adapt/loop/cycle_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "adapt/solvers/cycle_paths.hpp"
#include "flow/postprocess/flow_quantities.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "io/mesh_file.hpp"
#include "io/parts/part_output.hpp"
#include "io/text/text_output.hpp"
#include "io/tree/tree_file.hpp"

namespace quadloop::adapt {

namespace {

/// Writes a text from the root rank. *Collective.*
void write_text(const Communicator& comm, const std::string& path, const std::string& text) {
  io::OutputSet outputs(comm);
  io::TextOutput file(outputs, path);
  file.write(text);
  file.close();
  outputs.commit();
}

/// Writes the tables of walls and history, if the solver provides them. *Collective.*
void write_tables(const Communicator& comm, const Mesh& mesh, const flow::SolvedFlow& flow,
                  const CyclePaths& paths) {
  if (flow.stream) {
    std::vector<std::string> walls;
    for (const flow::BoundaryForce& force : flow.forces) walls.push_back(force.boundary);
    const Field& at_walls = flow.at_walls.empty() ? flow.solution : flow.at_walls;
    write_text(comm, paths.walls(), flow::wall_table(comm, mesh, at_walls, *flow.stream, walls));
  }
  if (!flow.history.empty()) write_text(comm, paths.history(), flow::history_table(flow.history));
}

std::string log_text(const CycleRecord& record, const std::vector<std::string>& notes,
                     const std::vector<std::string>& warnings) {
  std::string text = fmt::format("cycle {}: {} nodes, {} triangles, {} quads, {}\n", record.cycle,
                                 record.nodes, record.triangles, record.quads, quality_text(record));
  for (const auto& [boundary, least, largest] : record.first_heights)
    text += fmt::format("target first heights on {}: {:.6g} to {:.6g}\n", boundary, least, largest);
  for (const auto& [boundary, least, largest] : record.thickness)
    text += fmt::format("target thickness of layers on {}: {:.6g} to {:.6g}\n", boundary, least, largest);
  if (record.metric) text += lines_of(*record.metric);
  for (const std::string& line : notes) text += line + "\n";
  for (const flow::GoalValue& goal : record.goals) text += line_of(goal) + "\n";
  for (const std::string& line : warnings) text += "warning: " + line + "\n";
  if (record.estimate) text += fmt::format("error {:.4g}", *record.estimate);
  if (record.order) text += fmt::format(", order {:.2f}", *record.order);
  if (record.estimate) text += "\n";
  text += fmt::format("next cycle: {} quadtree cells to refine, {} to coarsen\n", record.refined,
                      record.coarsened);
  for (const auto& [stage, seconds] : record.seconds) text += fmt::format("{} {:.2f} s\n", stage, seconds);
  return text;
}

}  // namespace

CycleFiles::CycleFiles(const Communicator& comm, CycleFolders& folders, CycleFileOptions options, Report told)
    : comm_{comm}, folders_{folders}, options_{std::move(options)}, told_{std::move(told)} {}

void CycleFiles::begin(int cycle) {
  cycle_ = cycle;
  of_case_ = options_.of_case();
  folders_.begin(cycle);
}

void CycleFiles::meshed(const MeshResult& mesh, const Field& start) {
  starts_afresh_ = start.empty();
  const CyclePaths paths{folders_.under_way(cycle_)};
  io::OutputSet outputs(comm_);
  io::write_mesh(outputs, mesh.mesh, paths.native_mesh(), starts_afresh_ ? nullptr : &start);
  io::write_tree(outputs, mesh.tree, paths.tree());
  outputs.commit();
  if (options_.outline)
    write_text(comm_, paths.outline(), comm_.is_root() ? options_.outline() : std::string());
  if (options_.partitions == 0) return;
  cell_parts_ = partition(comm_, mesh.mesh, options_.partitions);
  write_parts_of(mesh.mesh, starts_afresh_ ? nullptr : &start);
}

/// Writes the partitions of the mesh, with the names of CyclePaths::mesh().
void CycleFiles::write_parts_of(const Mesh& mesh, const Field* field) const {
  if (options_.partitions == 0) return;
  io::PartFiles files(comm_);
  io::write_parts(files, comm_, mesh, cell_parts_, field,
                  {CyclePaths{folders_.under_way(cycle_)}.stem(), options_.partitions,
                   io::part_formats(options_.formats, mesh.blocks.names.size())});
  files.commit();
}

std::vector<std::string> CycleFiles::solved(const Mesh& mesh, const flow::SolvedFlow& flow) {
  const CyclePaths paths{folders_.under_way(cycle_)};
  Field shown;
  if (flow.stream && !options_.fields.empty()) {
    comm_.together([&] { shown = flow::with_quantities(flow.solution, options_.fields, *flow.stream); });
  }
  io::OutputSet outputs(comm_);
  for (const std::string& format : options_.formats) {
    const bool is_gone_on_from = format == io::native_format().name;
    io::write_mesh(outputs, mesh, paths.mesh(format),
                   shown.empty() || is_gone_on_from ? &flow.solution : &shown, options_.gamma);
  }
  outputs.commit();
  write_parts_of(mesh, &flow.solution);
  write_tables(comm_, mesh, flow, paths);
  return starts_afresh_ ? renames(mesh) : std::vector<std::string>{};  // reported for the first cycle only
}

/// Returns the names that are changed in any file that a cycle's mesh is written to.
std::vector<std::string> CycleFiles::renames(const Mesh& mesh) const {
  std::vector<std::string> files = options_.read_by_solver;
  for (const std::string& format : options_.formats) files.push_back(CyclePaths::mesh_name(format));
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::vector<std::string> lines;
  for (const std::string& file : files) {
    for (std::string& line : io::changes_in(mesh, file)) lines.push_back(std::move(line));
  }
  return lines;
}

void CycleFiles::planned(const CycleEnd& end) {
  if (!end.plan.estimate) return;
  Field estimates;
  estimates.cells = end.plan.estimates_of_cells;
  io::OutputSet outputs(comm_);
  io::write_mesh(outputs, end.solved.mesh, CyclePaths{folders_.under_way(cycle_)}.estimate(), &estimates);
  outputs.commit();
}

void CycleFiles::finished(CycleRecord record, const std::vector<std::string>& notes,
                          const std::vector<std::string>& warnings) {
  record.geometry_digest = of_case_.geometry_digest;
  record.case_digest = of_case_.case_digest;
  record.template_digest = of_case_.template_digest;
  record.settings = of_case_.settings;
  const CyclePaths paths{folders_.under_way(record.cycle)};
  write_text(comm_, paths.log(), log_text(record, notes, warnings));
  write_text(comm_, paths.record(), json_text(record));
  folders_.finish(record.cycle);
  told_(record, warnings);
}

std::string CycleFiles::place_of_solution(int cycle) const {
  return CyclePaths{folders_.under_way(cycle)}.native_mesh();
}

}  // namespace quadloop::adapt
