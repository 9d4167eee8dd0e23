#include "adapt/remesh/morphed_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "adapt/morph/outline_pieces.hpp"
#include "generate/digests.hpp"
#include "mesher/base/error.hpp"
#include "mesher/build/islands.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::adapt {

namespace {

/// Returns the first error of a distributed mesh; empty if it is valid. *Collective.*
std::string first_fault(const Communicator& comm, const Mesh& mesh) {
  const Mesh whole = gather_whole(comm, mesh);
  std::vector<char> said;
  if (comm.is_root()) {
    const std::vector<MeshFault> faults = validate(whole, cell_blocks(whole));
    if (!faults.empty()) said.assign(faults.front().what.begin(), faults.front().what.end());
  }
  comm.broadcast(said);
  return {said.begin(), said.end()};
}

/// Returns the report of a mesh that is kept, with the data that mesh generation would report. *Collective.*
MeshReport report_of(const Communicator& comm, const TreeRecord& tree) {
  MeshReport report;
  int coarsest = std::numeric_limits<std::int8_t>::max(), finest = 0;
  for (const LeafRecord& leaf : tree.leaves) {
    coarsest = std::min<int>(coarsest, leaf.level);
    finest = std::max<int>(finest, leaf.level);
  }
  report.leaves = comm.sum(std::ssize(tree.leaves));
  report.coarsest_level = static_cast<int>(comm.minimum(std::int64_t{coarsest}));
  report.finest_level = static_cast<int>(comm.maximum(std::int64_t{finest}));
  report.finest_allowed = report.finest_level;
  report.estimate.cells = static_cast<double>(tree.attributes.triangles + tree.attributes.quads);
  return report;
}

/// Returns the solved mesh with moved nodes, as if it had been generated on the input's geometry. The tree is
/// the old one, adjusted to these nodes. *Collective.*
RemeshedSolution with_nodes_of(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                               Mesh mesh) {
  RemeshedSolution remeshed;
  MeshResult& result = remeshed.generated.result;
  result.tree = old.tree;
  result.tree.attributes.geometry_digest = input.geometry.digest();
  result.tree.attributes.coordinate_digest = coordinate_digest(comm, mesh);
  result.report = report_of(comm, old.tree);
  result.mesh = std::move(mesh);
  remeshed.start = old.solution;
  remeshed.report = TransferReport::without_drift(old.solution);
  remeshed.morphed = true;
  return remeshed;
}

bool has_outline_of(const SolvedMesh& old, const MeshInput& input) {
  return input.geometry.digest() == old.tree.attributes.geometry_digest;
}

}  // namespace

MorphedMesh morph_solved(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                         const MorphWish& wish) {
  if (has_outline_of(old, input)) return {};
  StageTimes times;
  times.begin("morph");
  Mesh mesh = old.mesh;
  MorphReport report;
  try {
    MeshReport reported_already;
    const Geometry to = without_small_islands(input.geometry, input.mesh.size.min, reported_already);
    std::optional<OutlinePieces> pieces;
    if (to.has_twins() && wish.from_chains != nullptr) pieces = pieces_of(*wish.from_chains, chains_of(to));
    report = pieces ? morph_mesh(comm, mesh, {pieces->to, wish.file, &pieces->from, wish.from_file, true})
                    : morph_mesh(comm, mesh, {to, wish.file, wish.from, wish.from_file});
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
  if (!report.valid()) return {{}, text_of_inversion(report)};
  if (report.worst_after < wish.least_quality)
    return {{}, fmt::format("the worst cell's quality fell to {:.3f}", report.worst_after)};
  if (const std::string fault = first_fault(comm, mesh); !fault.empty()) return {{}, fault};
  times.end();
  MorphedMesh morphed{with_nodes_of(comm, input, old, std::move(mesh)), {}};
  morphed.remeshed->times = std::move(times);
  return morphed;
}

std::string why_anew(const MorphWish& wish, const std::string& refusal) {
  return fmt::format(
      "{}: a new mesh was generated, because morphing would reduce the cell quality below {:g} "
      "(design.morph_to): {}",
      wish.file, wish.least_quality, refusal);
}

namespace {

constexpr const char* what_shapes_cells = "the settings that shape the mesh (mesh, spacing, layers)";

std::vector<Point> sorted_points(const Geometry& outline) {
  std::vector<Point> points;
  for (std::int32_t v = 0; v < outline.size(); ++v) points.push_back(outline.point(v));
  std::ranges::sort(points);
  return points;
}

/// Whether the case specifies other cells than those of the solved mesh, judging by its tree, its geometry
/// and the recorded settings of its case.
bool has_other_settings(const MeshInput& input, const SolvedMesh& old, const MorphWish& wish) {
  if (old.tree.attributes.case_digest != input.digest || !wish.changed.empty()) return true;
  if (wish.from == nullptr) return false;
  MeshReport reported_already;
  const Geometry to = without_small_islands(input.geometry, input.mesh.size.min, reported_already);
  return sorted_points(*wish.from) == sorted_points(to);
}

/// Returns the reason, for a mesh that is not to be morphed or whose geometry has not changed.
std::string why_not_kept(const MeshInput& input, const SolvedMesh& old, bool wished) {
  const std::string why = has_outline_of(old, input)
                              ? fmt::format("{} have changed", what_shapes_cells)
                              : "the geometry or the settings of its boundaries have changed";
  const std::string cure = wished || has_outline_of(old, input)
                               ? ""
                               : "; set design.morph_to in the case file to morph the mesh instead";
  return fmt::format("a new mesh was generated instead of {}, because {}{}", old.file, why, cure);
}

/// Returns a warning about a mesh that was morphed without its geometry.
std::string without_former_outline(const SolvedMesh& old) {
  return fmt::format(
      "{}: the geometry of this mesh is not stored beside it as {}, so the points of the old and the new "
      "boundaries correspond by arc length, not by number, which changes the forces slightly; to store it, "
      "put [design] into the case file before the first run, or use mesh --geometry-out",
      old.file, std::filesystem::path(old.file).filename().replace_extension(".geom").string());
}

/// Returns a warning about anisotropic cells that a mesh generated from the tree alone does not have.
std::string without_stretched_cells(const SolvedMesh& old, const char* setting) {
  return fmt::format(
      "{}: {}: cycle 0 is the mesh of the case's quadtree, without anisotropic cells; the first adaptation "
      "creates them",
      old.file, setting);
}

}  // namespace

RemeshedSolution continued_mesh(const Communicator& comm, const MeshInput& input, const SolvedMesh& old,
                                const std::optional<MorphWish>& wish, TransferKind transfer) {
  if (has_outline_of(old, input) && old.tree.attributes.case_digest == input.digest)
    return with_nodes_of(comm, input, old, old.mesh);
  MorphedMesh morphed;
  if (wish) morphed = morph_solved(comm, input, old, *wish);
  if (morphed.remeshed) {
    std::vector<std::string>& warnings = morphed.remeshed->generated.result.report.warnings;
    const bool knows_chains = wish->from_chains != nullptr && !wish->from_chains->empty();
    if (wish->from == nullptr && !knows_chains) warnings.push_back(without_former_outline(old));
    if (has_other_settings(input, old, *wish))
      warnings.push_back(fmt::format(
          "{}: {} have changed since this mesh was generated{}; its cells are kept, and the new settings "
          "take effect at the next remeshing",
          old.file, what_shapes_cells, wish->changed.empty() ? "" : ": " + wish->changed));
    return std::move(*morphed.remeshed);
  }
  AdaptationPlan plan = unchanged_plan(old.tree, input);
  plan.transfer = transfer;
  RemeshedSolution remeshed = remesh_and_transfer(comm, input, plan, old);
  std::vector<std::string>& warnings = remeshed.generated.result.report.warnings;
  warnings.push_back(morphed.refusal.empty() ? why_not_kept(input, old, wish.has_value())
                                             : why_anew(*wish, morphed.refusal));
  if (const char* setting = setting_that_follows(input))
    warnings.push_back(without_stretched_cells(old, setting));
  return remeshed;
}

}  // namespace quadloop::adapt
