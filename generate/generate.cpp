#include "generate/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "generate/digests.hpp"
#include "generate/free_baffles.hpp"
#include "generate/match_pairs.hpp"
#include "generate/nearer_chords.hpp"
#include "generate/outside_layers.hpp"
#include "generate/refine_front.hpp"
#include "generate/sizes_of_wakes.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/build/required_points.hpp"
#include "mesher/build/split_quads.hpp"
#include "mesher/cut/grid_rank.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/layers/add_interface_layers.hpp"
#include "mesher/layers/add_layers.hpp"
#include "mesher/layers/add_strips.hpp"
#include "mesher/mesh/block_runs.hpp"
#include "mesher/mesh/check/require_sound.hpp"
#include "mesher/mesh/mirror_images.hpp"
#include "smoother/outline/nodes_on_curves.hpp"
#include "smoother/smooth_mesh.hpp"

namespace quadloop {

namespace {

bool keeps_parallelograms(const MeshOptions& mesh) {
  return mesh.type == MeshType::hybrid && mesh.quads == QuadChoice::parallel;
}

std::function<TieRank(Point)> order_of_nodes(const MeshInput& input, int finest_level) {
  return [grid = input.grid(), finest_level, mirror = input.mesh.mirror](Point p) {
    return tie_rank(grid, finest_level, p, mirror);
  };
}

/// Order of nodes for the cells of layers. If the mesh must be its own mirror image, nodes rank as their
/// images do: quads that are their own images are not split, as no diagonal is its own image.
std::function<TieRank(Point)> order_in_layers(const MeshInput& input, int finest_level) {
  const std::function<TieRank(Point)> order = order_of_nodes(input, finest_level);
  if (!input.mesh.mirror) return order;
  return [order, axis = *input.mesh.mirror](Point p) {
    return order(side_of(axis, p) < 0 ? image_of(axis, p) : p);
  };
}

/// Counts the triangles of each quadtree cell after flips: those stored in the slots of its former triangles.
void count_triangles(const std::vector<std::int32_t>& standing, std::vector<LeafRecord>& leaves) {
  auto slot = standing.begin();
  for (LeafRecord& leaf : leaves) {
    const auto end = slot + leaf.triangles;
    leaf.triangles = std::accumulate(slot, end, std::int32_t{0});
    leaf.block = leaf.triangles + leaf.quads == 0 ? std::int16_t{0} : std::max<std::int16_t>(leaf.block, 1);
    slot = end;
  }
}

/// Returns a flag for each owned node: whether it is among `nodes`, which must be sorted.
NodeFlags owned_among(const std::vector<GlobalNodeId>& nodes, const Mesh& mesh) {
  NodeFlags flags(mesh.owned_nodes, 0);
  for (const NodeId node : flags.ids()) flags[node] = std::ranges::binary_search(nodes, mesh.global(node));
  return flags;
}

/// The nodes of baffles, which stay so that those of the two sides match. *Collective.*
std::vector<GlobalNodeId> nodes_of_baffles(const Communicator& comm, const Geometry& geometry,
                                           const Mesh& mesh) {
  std::vector<GlobalNodeId> own;
  if (std::ranges::none_of(geometry.boundaries(), &Boundary::baffle)) return own;
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    if (!geometry.boundaries()[b].baffle) continue;
    for (const auto& [from, to] : mesh.boundaries[b].edges)
      own.insert(own.end(), {mesh.global(from), mesh.global(to)});
  }
  return comm.all_gather_values(std::span<const GlobalNodeId>(own));
}

void smooth(const Communicator& comm, const MeshInput& input, const std::vector<GlobalNodeId>& pinned,
            MeshResult& result) {
  if (input.smooth.sweeps == 0) return;
  const int finest = result.report.finest_allowed;
  smoother::SmoothOptions options = smooth_options_for(input, finest);
  std::vector<GlobalNodeId> fixed = pinned;
  const std::vector<GlobalNodeId> of_baffles = nodes_of_baffles(comm, input.geometry, result.mesh);
  fixed.insert(fixed.end(), of_baffles.begin(), of_baffles.end());
  for (const NamedNode& named : result.mesh.named_nodes) fixed.push_back(named.node);
  std::ranges::sort(fixed);
  if (!fixed.empty()) options.pinned = owned_among(fixed, result.mesh);
  options.triangle_to_block = result.mesh.blocks.of_triangles;
  options.keep_slots = !has_triangles_alone(input.mesh.type) || input.geometry.has_blocks();
  const smoother::SmoothReport report = smoother::smooth_mesh(comm, result.mesh, options);
  if (!report.standing.empty()) count_triangles(report.standing, result.tree.leaves);
  if (keeps_parallelograms(input.mesh)) {  // moved nodes make some skew; these are split too
    split_skew_quads(result.mesh, result.tree.leaves, order_of_nodes(input, finest));
  }
  log::detail(fmt::format("smoothed: {} moves of {} nodes in {} sweeps; largest cost {:.4f}, before {:.4f}",
                          report.moves, report.free_nodes, report.sweeps, report.worst_cost_after,
                          report.worst_cost_before));
}

/// Stores the number of layers of each boundary in the mesh, for output files; not of those with layers in
/// some of their blocks only.
void name_layers(const Geometry& geometry, Mesh& mesh) {
  std::vector<char> has_other_parts(mesh.boundaries.size(), 0);
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (!geometry.asks_for_layers(s) || geometry.twin(s) >= 0)
      has_other_parts[geometry.boundary_of(s).value()] = 1;
  }
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    const auto& layers = geometry.boundaries()[b].layers;
    if (layers && has_other_parts[b] == 0)
      mesh.boundaries[b].layers = {layers->count, layers_thickness(*layers)};
  }
}

/// Adds the layers of all walls that have them. *Collective.*
void fill_layers(const Communicator& comm, const MeshInput& input, const LayerFront& front,
                 MeshResult& result) {
  DivideBy divide;
  if (divides_layers(input.mesh.type)) divide = order_in_layers(input, result.report.finest_allowed);
  add_layers(comm, front, result.edge_leaves, divide, result.mesh, result.tree.leaves);
  if (front.on_interfaces)
    add_interface_layers(comm, front, result.edge_leaves, divide, result.mesh, result.tree.leaves);
  if (front.has_strips())
    add_strips(comm, front, result.edge_leaves, divide, result.mesh, result.tree.leaves);
  name_layers(input.geometry, result.mesh);
  result.tree.attributes.geometry_digest = input.geometry.digest();
}

/// Makes a mesh Delaunay again after nodes have moved, if it is to be. *Collective.*
void restore_after(const Communicator& comm, const MeshInput& input, const NodeFlags& moved,
                   MeshResult& result) {
  if (!has_triangles_alone(input.mesh.type) || !comm.any(!moved.empty())) return;  // a rank may have no nodes
  const auto order = order_of_nodes(input, result.report.finest_allowed);
  if (input.geometry.has_blocks())
    restore_delaunay(comm, result.mesh, moved, order, result.mesh.blocks.of_triangles);
  else
    count_triangles(restore_delaunay_nearby(comm, result.mesh, moved, order), result.tree.leaves);
}

/// Builds a mesh whose quadtree cells have the same sizes on both sides of periodic pairs, and whose baffles
/// have separate nodes on both sides. *Collective.*
MeshResult build_with_partners(const Communicator& comm, const MeshInput& input,
                               const DemandedSplits& demanded) {
  const std::vector<PeriodicPair>& pairs = input.mesh.pairs;
  MeshResult result = build_mesh(comm, input.geometry, input.mesh, demanded);
  DemandedSplits splits = demanded;
  while (demand_sizes_of_partners(comm, input.geometry, pairs, result, splits))
    result = build_mesh(comm, input.geometry, input.mesh, splits);
  restore_after(comm, input, divide_free_baffles(comm, input.geometry, result), result);
  if (pairs.empty()) return result;
  forget_splits(demanded, result.tree);
  restore_after(comm, input, match_pairs(comm, input.geometry, pairs, result), result);
  if (keeps_parallelograms(input.mesh))
    split_skew_quads(result.mesh, result.tree.leaves, order_of_nodes(input, result.report.finest_allowed));
  return result;
}

/// Builds a mesh without smoothing, with its boundary nodes on the geometry's curves. Where cells would be
/// inverted, the chords that the mesh is built on are made shorter. *Collective.*
GeneratedMesh build(const Communicator& comm, const MeshInput& input, const DemandedSplits& demanded) {
  constexpr int most_halvings = 8;
  GeneratedMesh generated;
  MeshResult& result = generated.result;
  NodeFlags moved;
  StageTimes trials;
  std::optional<MeshInput> shorter;
  std::uint64_t digest = 0;
  for (int halvings = 0;; ++halvings) {
    const MeshInput& used = shorter ? *shorter : input;
    result = build_with_partners(comm, used, demanded);
    if (halvings == 0) digest = result.tree.attributes.geometry_digest;
    require_area(comm, used.geometry, result.report.area_dropped, result.mesh);
    moved = smoother::move_nodes_to_curves(comm, used.geometry, result.mesh);
    if (moved.empty() || !input.mesh.pairs.empty() || halvings == most_halvings) break;
    std::optional<Geometry> nearer = nearer_chords(comm, used.geometry, result.mesh);
    if (!nearer) break;
    trials.append(result.report.times);
    if (!shorter) shorter = input;
    shorter->geometry = *std::move(nearer);
  }
  result.tree.attributes.geometry_digest = digest;
  if (!trials.stages().empty()) generated.times.append_as("trials", trials);
  generated.times.append(result.report.times);
  place_images(comm, input.mesh.pairs, result.mesh);
  result.mesh.pairs = input.mesh.pairs;
  restore_after(comm, input, moved, result);
  result.mesh.named_nodes = nodes_at(comm, input.mesh.required_points, result.mesh);
  return generated;
}

/// Smooths the mesh with fixed nodes `pinned`, which must be sorted. *Collective.*
void smooth(const Communicator& comm, const MeshInput& input, const std::vector<GlobalNodeId>& pinned,
            GeneratedMesh& generated) {
  generated.times.begin("smooth");
  smooth(comm, input, pinned, generated.result);
  generated.times.end();
  require_area(comm, input.geometry, generated.result.report.area_dropped, generated.result.mesh, true);
}

/// Applies the callback before the layers are generated. *Collective.*
void change(const Communicator& comm, const MeshInput& input, const MeshChange& change,
            GeneratedMesh& generated) {
  if (!change) return;
  generated.times.begin("stretch");
  const progress::SharedStage stage(comm, "stretching");
  change(input, generated.result);
  generated.times.end();
  require_area(comm, input.geometry, generated.result.report.area_dropped, generated.result.mesh, true);
}

/// The mesh outside the layers, on which all columns must be valid. Where a column is invalid, the mesh is
/// made again: first with more nodes on the unsmoothed mesh, then with fewer free nodes in smoothing.
/// *Collective.*
class OutsideMesh {
 public:
  OutsideMesh(const Communicator& comm, const MeshInput& input, const DemandedSplits& demanded,
              LayerFront& front)
      : comm_{comm},
        input_{input},
        demanded_{demanded},
        splits_{demanded},
        front_{front},
        grid_{input.grid()},
        outer_{outside(input, front)} {}

  GeneratedMesh made(const MeshChange& wanted) {
    cut();
    for (int attempt = 0; !columns_stand_when_smooth() && attempt < most_attempts; ++attempt) {
      discard();
      mesh_ = build(comm_, outer_, splits_);
    }
    forget_splits(demanded_, mesh_.result.tree);
    require_not_inverted(comm_, outer_.geometry, mesh_.result.mesh);
    change(comm_, outer_, wanted, mesh_);
    StageTimes times;
    if (!trials_.stages().empty()) times.append_as("trials", trials_);
    times.append(mesh_.times);
    mesh_.times = times;
    return std::move(mesh_);
  }

 private:
  static constexpr int most_attempts = 16;

  void cut() {
    mesh_ = build(comm_, outer_, splits_);
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      if (!refine_front(comm_, grid_, mesh_.result, front_, splits_)) return;
      discard();
      outer_ = outside(input_, front_);
      mesh_ = build(comm_, outer_, splits_);
    }
  }

  bool columns_stand_when_smooth() {
    smooth(comm_, outer_, pinned_, mesh_);
    const std::vector<GlobalNodeId> unsound = unsound_nodes(comm_, front_, mesh_.result);
    pinned_.insert(pinned_.end(), unsound.begin(), unsound.end());
    std::ranges::sort(pinned_);
    return unsound.empty();
  }

  void discard() { trials_.append(std::exchange(mesh_, {}).times); }

  const Communicator& comm_;
  const MeshInput& input_;
  const DemandedSplits& demanded_;
  DemandedSplits splits_;
  LayerFront& front_;
  TreeGrid grid_;
  MeshInput outer_;
  GeneratedMesh mesh_;
  std::vector<GlobalNodeId> pinned_;
  StageTimes trials_;
};

void add_dropped(const MeshReport& dropped, MeshReport& report) {
  report.islands_dropped += dropped.islands_dropped;
  report.area_dropped += dropped.area_dropped;
  report.warnings.insert(report.warnings.begin(), dropped.warnings.begin(), dropped.warnings.end());
  const std::set<std::string> known(report.boundaries_vanished.begin(), report.boundaries_vanished.end());
  std::ranges::copy_if(dropped.boundaries_vanished, std::back_inserter(report.boundaries_vanished),
                       [&](const std::string& name) { return !known.contains(name); });
}

/// Adds the cells of strips, known by now, to the estimate, which is that of the mesh outside.
void add_strips_to(const LayerFront& front, bool divided, MeshEstimate& estimate) {
  for (const LayerStrip& strip : front.strips) {
    const double of_columns =
                     static_cast<double>(strip.columns.size() - 1) * (2.0 * strip.layers + strip.core),
                 of_base = strip.base_layers() * (strip.core - 2.0 * strip.base_layers());
    const double cells = (of_columns + of_base) * (divided ? 2 : 1);
    estimate.cells += cells;
    estimate.layer_cells += cells;
  }
}

GeneratedMesh generate_layered(const Communicator& comm, const MeshInput& input,
                               const DemandedSplits& demanded, const MeasuredFlow& measured,
                               const MeshChange& change) {
  StageTimes times;
  times.begin("layer edge");
  MeshReport dropped;
  const Geometry geometry = geometry_with_layers(input, dropped);
  LayerFront front = front_of(comm, input, geometry, measured, demanded);
  times.end();
  GeneratedMesh generated = OutsideMesh(comm, input, demanded, front).made(change);
  add_dropped(dropped, generated.result.report);
  add_strips_to(front, divides_layers(input.mesh.type), generated.result.report.estimate);
  times.append(generated.times);
  times.begin("layers");
  const progress::SharedStage stage(comm, "layers");
  generated.layers = report_layers(comm, front, generated.result.mesh);
  for (std::string& warning : warnings_of(generated.layers))
    generated.result.report.warnings.push_back(std::move(warning));
  for (std::string& warning : size_warnings(front, input.mesh.size.min))
    generated.result.report.warnings.push_back(std::move(warning));
  fill_layers(comm, input, front, generated.result);
  require_area(comm, input.geometry, generated.result.report.area_dropped, generated.result.mesh);
  if (wants_y_plus(input.geometry)) generated.result.tree.measured.walls = measured.walls;
  if (wants_thickness_of_flow(input.geometry)) generated.result.tree.measured.thickness = measured.thickness;
  times.end();
  generated.times = times;
  return generated;
}

GeneratedMesh generate_plain(const Communicator& comm, const MeshInput& input, const DemandedSplits& demanded,
                             const MeshChange& wanted) {
  GeneratedMesh generated = build(comm, input, demanded);
  smooth(comm, input, {}, generated);
  require_not_inverted(comm, input.geometry, generated.result.mesh);
  change(comm, input, wanted, generated);
  return generated;
}

}  // namespace

smoother::SmoothOptions smooth_options_for(const MeshInput& input, int finest_level) {
  smoother::SmoothOptions options = input.smooth;
  options.geometry = &input.geometry;
  options.mirror = input.mesh.mirror;
  if (keeps_parallelograms(input.mesh)) options = smoother::sparing_parallelograms(options);
  if (has_triangles_alone(input.mesh.type)) options.delaunay = order_of_nodes(input, finest_level);
  return options;
}

GeneratedMesh generate_mesh(const Communicator& comm, const MeshInput& given, const DemandedSplits& demanded,
                            const MeasuredFlow& measured, const MeshChange& change) {
  std::vector<std::string> warnings;
  const std::optional<MeshInput> sized = with_sizes_of_wakes(given, measured, warnings);
  const MeshInput& input = sized ? *sized : given;
  GeneratedMesh generated = has_layers(input) ? generate_layered(comm, input, demanded, measured, change)
                                              : generate_plain(comm, input, demanded, change);
  MeshResult& result = generated.result;
  result.report.warnings.insert(result.report.warnings.end(), warnings.begin(), warnings.end());
  if (wants_streamlines(input)) result.tree.measured.wakes = measured.wakes;
  generated.times.begin("check");
  place_images(comm, input.mesh.pairs, result.mesh);
  result.mesh.named_nodes = nodes_at(comm, input.mesh.required_points, result.mesh);
  require_sound(comm, result.mesh);
  generated.times.end();
  if (input.mesh.mirror) require_mirror_images(comm, result.mesh, *input.mesh.mirror);
  count_entries(comm, result);
  result.tree.block_runs = block_runs(comm, result.mesh);
  result.tree.attributes.case_digest = input.digest;
  result.tree.attributes.coordinate_digest = coordinate_digest(comm, result.mesh);
  return generated;
}

}  // namespace quadloop
