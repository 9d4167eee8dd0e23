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

/// All that a mesh is made from, beside what adaptation demands; the same on every rank.
struct MeshInput {
  Geometry geometry;
  MeshOptions mesh;
  SmoothOptions smooth;      ///< without the geometry
  std::uint64_t digest = 0;  ///< of the case: case_digest() of its own mesh options and lines
  std::vector<LayerLine> lines = {};
  /// Where cells are to follow the solution on the last mesh: so many times thinner at most than the tree
  /// makes them (adapt/targets).
  std::optional<double> stretch = {};

  /// That of the whole domain, on which the mesh outside layers is made too.
  Lattice lattice() const { return choose_root(geometry, mesh.size.root); }
};

/// A smoothed mesh and its tree record, complete but for what a file adds.
struct GeneratedMesh {
  MeshResult result;
  StageTimes times;    ///< those of the report, "smooth" and "check"
  LayerReport layers;  ///< of the boundaries that have any
};

/// How the meshes of this input are smoothed: along its geometry, which must outlive the options, sparing
/// parallelograms where no other quadrilaterals are kept. A mesh of the Delaunay type ends with flips, under
/// the order of nodes that it has with leaves down to `finest_level`.
SmoothOptions smooth_options_for(const MeshInput& input, int finest_level);

/// What is done to a smoothed mesh before layers are filled: `input` is that of the mesh, the domain outside
/// layers where there are any. Nodes on the front of layers must stay, and the tree must count the cells.
/// *Collective.*
using MeshChange = std::function<void(const MeshInput& input, MeshResult& result)>;

/// Meshes and smooths; smoothing always begins with the mesh as it is cut, and a mesh of the Delaunay type
/// ends with flips, under the order of nodes that it was made with. First heights of layers that want a y+
/// follow the measured wall, which the tree keeps. *Collective.* Throws InputError as build_mesh does, and
/// Fault where the mesh is not valid (require_sound()).
GeneratedMesh generate_mesh(const Communicator& comm, const MeshInput& input,
                            const DemandedSplits& demanded = {}, const MeasuredWall& measured = {},
                            const MeshChange& change = {});

}  // namespace quadloop
