#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/layers/layer_report.hpp"
#include "mesher/sizes/demanded_splits.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop {

/// All inputs of mesh generation except the adaptation splits; the same on every rank.
struct MeshInput {
  Geometry geometry;
  MeshOptions mesh;
  smoother::SmoothOptions smooth;  ///< without the geometry
  std::uint64_t digest = 0;        ///< case_digest() of the case's own mesh options and lines
  std::vector<LayerLine> lines = {};
  /// Maximum aspect ratio for r-adaptation (relative to the quadtree cell; adapt/r_adaptation); empty: no
  /// r-adaptation.
  std::optional<double> stretch = {};

  /// Returns the background grid of the whole domain, which is also that of the mesh outside layers.
  TreeGrid grid() const { return choose_root(geometry, mesh.size.root); }
};

/// A smoothed mesh and its tree record, without the attributes that are set on writing.
struct GeneratedMesh {
  MeshResult result;
  StageTimes times;    ///< stages of the report, "smooth" and "check"
  LayerReport layers;  ///< of the boundaries that have layers
};

/// Returns the smoothing options for meshes of this input: nodes slide along its geometry, which must outlive
/// the options; parallelograms are preserved if no other quads are kept. Delaunay-type meshes end with flips,
/// with the node order of quadtree cells down to `finest_level`.
smoother::SmoothOptions smooth_options_for(const MeshInput& input, int finest_level);

/// Callback on the smoothed mesh before the layers are generated. `input` is that of the mesh (of the domain
/// outside layers, if there are any). Nodes on the outer edge of the layers must not move, and the tree must
/// count the cells. *Collective.*
using MeshChange = std::function<void(const MeshInput& input, MeshResult& result)>;

/// Generates and smooths a mesh. Smoothing starts from the mesh as cut; a Delaunay-type mesh ends with flips,
/// with the node order that it was made with. First heights of layers that specify a y+ follow the measured
/// wall friction, which the tree stores. Throws InputError as build_mesh does, and Fault if the mesh is not
/// valid (require_sound()). *Collective.*
GeneratedMesh generate_mesh(const Communicator& comm, const MeshInput& input,
                            const DemandedSplits& demanded = {}, const MeasuredWall& measured = {},
                            const MeshChange& change = {});

}  // namespace quadloop
