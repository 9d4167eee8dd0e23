#include "adapt/loop/cycle_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/files/output_file.hpp"
#include "io/mesh_file.hpp"
#include "io/native/native_file.hpp"
#include "io/tree/tree_file.hpp"

namespace quadloop {

namespace {

/// From the root rank. *Collective.*
void write_text(const Communicator& comm, const std::string& path, const std::string& text) {
  OutputSet outputs(comm);
  const StagedFile staged = outputs.stage(path);
  comm.together([&] {
    if (!comm.is_root()) return;
    OutputFile file(staged);
    file.write(text);
    file.close();
  });
  outputs.commit();
}

std::string log_text(const CycleRecord& record, const std::vector<std::string>& notes,
                     const std::vector<std::string>& warnings) {
  std::string text =
      fmt::format("cycle {}: {} nodes, {} triangles, {} quads, smallest angle {:.1f}\n", record.cycle,
                  record.nodes, record.triangles, record.quads, record.worst_angle);
  for (const std::string& line : notes) text += line + "\n";
  for (const std::string& line : warnings) text += "warning: " + line + "\n";
  text += fmt::format("marks for the next cycle: {} leaves to be split, {} to go\n", record.refined,
                      record.coarsened);
  for (const auto& [stage, seconds] : record.seconds) text += fmt::format("{} {:.2f} s\n", stage, seconds);
  return text;
}

}  // namespace

CycleFiles::CycleFiles(const Communicator& comm, CycleFolders& folders, CycleFileOptions options, Told told)
    : comm_{comm}, folders_{folders}, options_{std::move(options)}, told_{std::move(told)} {}

void CycleFiles::begin(int cycle) {
  cycle_ = cycle;
  folders_.begin(cycle);
}

void CycleFiles::meshed(const MeshResult& mesh, const Field& start) {
  starts_afresh_ = start.width() == 0;
  const std::string folder = folders_.under_way(cycle_);
  OutputSet outputs(comm_);
  write_native(outputs, mesh.mesh, folder + "/mesh.mesh", starts_afresh_ ? nullptr : &start);
  write_tree(outputs, mesh.tree, folder + "/mesh.tree.h5");
  outputs.commit();
}

std::vector<std::string> CycleFiles::solved(const Mesh& mesh, const Field& flow) {
  const std::string folder = folders_.under_way(cycle_);
  OutputSet outputs(comm_);
  write_native(outputs, mesh, folder + "/mesh.mesh", &flow);
  write_cgns(outputs, mesh, folder + "/mesh.cgns", &flow);
  for (const std::string& format : options_.formats) {
    if (format != "mesh" && format != "cgns")
      write_mesh(outputs, mesh, folder + "/mesh." + format, &flow, options_.gamma);
  }
  outputs.commit();
  return starts_afresh_ ? renames(mesh) : std::vector<std::string>{};  // said of the first cycle alone
}

/// Of every file that a cycle's mesh is written to.
std::vector<std::string> CycleFiles::renames(const Mesh& mesh) const {
  std::vector<std::string> files = options_.read_by_solver;
  files.emplace_back("mesh.cgns");
  for (const std::string& format : options_.formats) files.push_back("mesh." + format);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::vector<std::string> lines;
  for (const std::string& file : files) {
    for (std::string& line : renames_in(mesh, file)) lines.push_back(std::move(line));
  }
  return lines;
}

void CycleFiles::finished(CycleRecord record, const std::vector<std::string>& notes,
                          const std::vector<std::string>& warnings) {
  record.geometry_digest = options_.of_case.geometry_digest;
  record.case_digest = options_.of_case.case_digest;
  record.settings = options_.of_case.settings;
  const std::string folder = folders_.under_way(record.cycle);
  write_text(comm_, folder + "/log.txt", log_text(record, notes, warnings));
  write_text(comm_, folder + "/record.json", json_text(record));
  folders_.finish(record.cycle);
  told_(record, warnings);
}

std::string CycleFiles::place_of_solution(int cycle) const {
  return folders_.under_way(cycle) + "/mesh.mesh";
}

}  // namespace quadloop
