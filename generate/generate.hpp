#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/layers/layer_report.hpp"
#include "mesher/sizes/demanded_splits.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop {

/// All inputs of mesh generation except the adaptation splits; the same on every rank.
struct MeshInput {
  Geometry geometry;
  MeshOptions mesh;
  smoother::SmoothOptions smooth;  ///< its geometry is not set: smooth_options_for() sets it
  std::uint64_t digest = 0;        ///< case_digest() of the case's mesh options and lines
  /// Wakes and interior layer lines, with layers.
  std::vector<LayerLine> lines = {};
  /// Maximum aspect ratio for r-adaptation (relative to the quadtree cell; adapt/r_adaptation); empty: no
  /// r-adaptation.
  std::optional<double> stretch = {};
  /// Wakes that request cell sizes instead of layers (sources_of_wakes()).
  std::vector<LayerLine> wakes_without_layers = {};

  /// Returns the background grid of the whole domain. The mesh outside the layers uses the same grid.
  TreeGrid grid() const { return choose_root(geometry, mesh.size); }
};

/// A smoothed mesh and its tree record (the quadtree as it is stored in a file), without the attributes that
/// are set on writing.
struct GeneratedMesh {
  MeshResult result;
  StageTimes times;    ///< stages of the report, "smooth" and "check"
  LayerReport layers;  ///< of the boundaries that have layers
};

/// Returns the smoothing options for meshes of this input. Boundary nodes slide along its geometry, which
/// must outlive the options. With mesh.quads = "parallel", smoothing tries to keep parallelograms. In
/// meshes of triangles only, edge flips follow; for cocircular nodes the diagonal is chosen by the order of
/// the nodes along the space-filling curve of quadtree cells of level `finest_level`.
smoother::SmoothOptions smooth_options_for(const MeshInput& input, int finest_level);

/// Callback on the smoothed mesh before the layers are generated. With layers, `input` describes only the
/// domain outside them. The callback must not move nodes on the outer edge of the layers, and it must update
/// the cell counts in the tree record. *Collective.*
using MeshChange = std::function<void(const MeshInput& input, MeshResult& result)>;

/// Generates and smooths a mesh (smooth_options_for()). If layers specify a y+, their first heights follow
/// from the measured wall friction; wakes that follow the flow have the measured courses. Both are stored in
/// the tree record. Throws InputError as build_mesh does,
/// and Fault if the mesh is not valid (require_sound()). *Collective.*
GeneratedMesh generate_mesh(const Communicator& comm, const MeshInput& input,
                            const DemandedSplits& demanded = {}, const MeasuredFlow& measured = {},
                            const MeshChange& change = {});

}  // namespace quadloop
