#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "io/formats.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/transform.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "quadloop/case/flow_settings.hpp"
#include "quadloop/case/key_table.hpp"
#include "quadloop/case/solver_settings.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop {

/// One geometry file and how its coordinates are placed.
struct GeometryInput {
  std::string path;
  std::string where;  ///< the setting that names it, for messages
  Transform transform;
  io::DrawingChoice choice = {};
  /// "none": coordinates are taken unchanged; "file": in the unit that the file declares; or a name of
  /// length_units.hpp. Except for "none" coordinates are converted to metres.
  std::string unit = "none";
  bool spline = false;  ///< its points are joined by cubic splines from corner to corner
};

/// An outline of the case without a file, placed.
struct Shape {
  Chain chain;
  bool is_body = false;  ///< meshed around, unless Settings::inside
  bool spline = false;   ///< its points are joined by cubic splines from corner to corner
};

/// The files of a case and their placement: each list has one value for all files, or one per file.
struct Placement {
  std::vector<std::string> files, unit;
  io::DrawingChoice choice;
  std::optional<bool> spline;
  std::vector<double> scale, rotate;
  std::vector<Point> rotate_about, translate;
};

/// Extent and unit of a geometry file, before placement.
struct FileExtent {
  std::string path;
  Box box;
  io::FileUnit declared;
  double metres = 0;  ///< metres per unit of its coordinates; 0: no conversion
};

/// Far field of the case.
struct FarField {
  FarFieldShape shape = FarFieldShape::square;
  double radius = 0;                   ///< as far_field_box()
  std::optional<double> spacing = {};  ///< cell size at it
  std::string where = {};

  friend bool operator==(const FarField&, const FarField&) = default;
};

/// Half model: only the half of a symmetric geometry above the axis is meshed.
struct HalfDomain {
  MirrorAxis axis;
  std::string boundary;  ///< name of the boundary along the axis

  friend bool operator==(const HalfDomain&, const HalfDomain&) = default;
};

/// The contents of a case file, as options of each module.
struct Settings {
  std::string title;
  /// All keys on which files of a cycle depend: dotted name, JSON value.
  std::vector<std::pair<std::string, std::string>> values;
  Placement placement;
  std::vector<GeometryInput> files;  ///< from the placement
  std::vector<Shape> shapes;
  std::optional<FarField> far_field;
  bool inside = false;  ///< an airfoil without an outer boundary is meshed inside
  std::optional<HalfDomain> half;
  std::vector<double> root;  ///< mesh.root, from which the mesh options follow
  AssembleOptions outline;
  std::optional<double> min, max;  ///< spacing.min and spacing.max, where given
  MeshOptions mesh;                ///< without the sizes min and max, which may follow from the geometry
  smoother::SmoothOptions smooth;  ///< without the geometry
  std::optional<double> stretch;   ///< MeshInput::stretch
  std::vector<LayerLine> lines;    ///< wakes and free lines with layers
  std::vector<LayerLine> wakes_without_layers;
  std::optional<FlowSettings> flow;
  bool wants_y_plus = false;  ///< whether some layers specify a y+, which needs [flow]
  SolverSettings solver;
  std::optional<flow::FreeStream> stream;    ///< of an external solver, if [flow] specifies it
  std::optional<adapt::AdaptOptions> adapt;  ///< if the case has the table
  /// Least quality of the worst cell outside layers for which cells are kept on a changed geometry.
  std::optional<double> morph_to;
  std::string output_prefix;
  std::vector<std::string> formats = io::default_formats();
  std::vector<std::string> fields;  ///< of quantity_names(), written in addition to a solution
  /// Number of parts for a solver's ranks, written in addition to the whole mesh; 0: none.
  std::int32_t partitions = 0;
  Warnings warnings;  ///< about the case file itself
};

/// The top-level keys, and the tables [design] and [output].
const KeyTable<Settings>& title_keys();
const KeyTable<Settings>& design_keys();
const KeyTable<Settings>& output_keys();

/// Reads the case; assignments of the command line override its keys. On the calling rank only. Throws
/// InputError that names key and line.
Settings read_settings(const io::CaseSource& source, const std::vector<std::string>& assignments);

/// Returns the case's table [adapt]. Throws InputError, which names the case, if it has none.
const adapt::AdaptOptions& adapt_options(const Settings& settings, const std::string& case_path);

/// Returns the suffix of a mesh or tree file at the end of a prefix of output files, if any. This is a user
/// error, as suffixes are appended.
std::string format_suffix_of(const std::string& prefix);

/// Reads, places and assembles the geometry. If the root of the saved tree is a far field of the specified
/// size round the geometry, that far field is kept even if the centre of the geometry has moved. `extents`
/// gains one entry for each file. On the calling rank only.
Geometry load_geometry(const Settings& settings, Warnings& warnings,
                       const std::optional<TreeAttributes>& saved = {},
                       std::vector<FileExtent>* extents = nullptr);

/// The sizes of MeshOptions that may follow from the geometry.
struct CellSizes {
  double min = 0, max = 0, aim = 0;
};

/// Returns the sizes of the case, with defaults for those that it leaves open. max: 1/16 of the longer side
/// of the geometry's bounding box (or min if larger). min: half the smallest spacing that follows from its
/// points, boundaries, corners, layers, lines with layers, wakes or the case's sources, at least 2^-20 of
/// that side and at most half of max. The size that the root meets: the smallest that the case specifies for
/// a boundary, by its spacing or by twice the height of its last layer, else spacing.max, else the smallest
/// of the sizes above; within min and max.
CellSizes cell_sizes(const Settings& settings, const Geometry& geometry);

/// Returns the options with these sizes. Blocks that request a size are those of the geometry.
MeshOptions mesh_options(const Settings& settings, const Geometry& geometry, const CellSizes& sizes);
inline MeshOptions mesh_options(const Settings& settings, const Geometry& geometry) {
  return mesh_options(settings, geometry, cell_sizes(settings, geometry));
}

/// Returns a line for each boundary, sharp corner or source whose spacing is smaller than the smallest
/// quadtree cell, for each boundary with a corner spacing but no sharp corner, and for each source outside
/// the root of the quadtrees.
Warnings spacing_warnings(const MeshOptions& options, const Geometry& geometry);

/// Returns a line if the coordinates of a file are converted to metres, and spacing.max or the spacing of a
/// boundary is larger than the longer side of the geometry's bounding box: the lengths of the case may be in
/// the unit of the file.
std::optional<std::string> unit_warning(const std::vector<FileExtent>& files, const MeshOptions& options,
                                        const Geometry& geometry);

}  // namespace quadloop
