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
  std::vector<std::string> layers = {};  ///< of a drawing or map; empty: all, as read_geometry() says
  /// "none": coordinates as they stand; "file": in the unit that the file declares; or a name of
  /// length_units.hpp. But for "none" coordinates become metres.
  std::string unit = "none";
};

/// The files of a case and how they are placed: of each list one value for all files, or one for each.
struct Placement {
  std::vector<std::string> files, layers, unit;
  std::vector<double> scale, rotate;
  std::vector<Point> rotate_about, translate;
};

/// What one geometry file holds, as it stands there.
struct FileExtent {
  std::string path;
  Box box;
  FileUnit declared;
  double metres = 0;  ///< that one unit of its coordinates was taken for; 0: as they stand
};

/// The far field that the case asks for.
struct FarField {
  double half_width = 0;
  std::string where;

  friend bool operator==(const FarField&, const FarField&) = default;
};

/// That of a symmetric outline only the half above an axis is meshed.
struct HalfDomain {
  MirrorAxis axis;
  std::string boundary;  ///< the name of the boundary along the axis

  friend bool operator==(const HalfDomain&, const HalfDomain&) = default;
};

/// A case file as each module wants it.
struct Settings {
  std::string title;
  /// Of all keys but those that no file of a cycle depends on: dotted name, JSON.
  std::vector<std::pair<std::string, std::string>> values;
  Placement placement;
  std::vector<GeometryInput> files;  ///< by the placement
  std::optional<FarField> far_field;
  bool inside = false;  ///< an airfoil without an outer boundary is meshed inside
  std::optional<HalfDomain> half;
  std::vector<double> root;  ///< mesh.root, from which the mesh's options are
  AssembleOptions outline;
  std::optional<double> min, max;  ///< spacing.min and spacing.max, where given
  MeshOptions mesh;                ///< without the sizes min and max: those may follow from the geometry
  SmoothOptions smooth;            ///< without the geometry
  std::optional<double> stretch;   ///< MeshInput::stretch
  std::vector<LayerLine> lines;    ///< wakes and free lines with layers
  std::optional<FlowSettings> flow;
  bool wants_y_plus = false;  ///< some layers do, which [flow] tells the height of
  SolverSettings solver;
  std::optional<FreeStream> stream;   ///< of a solver of the user's, where [flow] tells it
  std::optional<AdaptOptions> adapt;  ///< where the case has a table for it
  /// Where the outline has changed, cells are kept as long as the worst one outside layers has this quality.
  std::optional<double> morph_to;
  std::string output_prefix;
  std::vector<std::string> formats = default_formats();
  std::vector<std::string> fields;  ///< of quantity_names(), written beside a solution
  std::int32_t partitions = 0;      ///< parts for a solver's ranks, written beside the whole; 0: none
  Warnings warnings;                ///< what the user is to be told of the case file itself
};

/// The keys above all tables, and the tables [design] and [output].
const KeyTable<Settings>& title_keys();
const KeyTable<Settings>& design_keys();
const KeyTable<Settings>& output_keys();

/// Reads the case file with the command line's assignments over it. On the calling rank alone. Throws
/// InputError that names key and line.
Settings read_settings(const std::string& case_path, const std::vector<std::string>& assignments);

/// The case's table [adapt]. Throws InputError, which names the case, where it has none.
const AdaptOptions& adapt_options(const Settings& settings, const std::string& case_path);

/// The suffix of a mesh or tree file that a prefix of output files ends in, if any: a slip, as suffixes are
/// added to it.
std::string format_suffix_of(const std::string& prefix);

/// Reads, places and assembles the geometry. Where a saved tree's root is a far field of the wanted size
/// round the geometry, the far field stands there again, though the geometry's centre may have moved. On the
/// calling rank alone. `extents` gains one entry for each file.
Geometry load_geometry(const Settings& settings, Warnings& warnings,
                       const std::optional<TreeAttributes>& saved = {},
                       std::vector<FileExtent>* extents = nullptr);

/// The options with the sizes that the case leaves open taken from the geometry: max is 1/16 of the longer
/// side of its box (or min if that is larger), min half the smallest spacing that its points, boundaries,
/// corners, layers, lines with layers or the case's sources ask for, or 2^-20 of that side if that is larger,
/// but at most half of max.
MeshOptions mesh_options(const Settings& settings, const Geometry& geometry);

/// One line for each boundary, sharp corner's boundary and source whose spacing is smaller than leaves may
/// be, for each boundary with a corner spacing and without a sharp corner, and for each source outside the
/// root of the trees.
Warnings spacing_warnings(const MeshOptions& options, const Geometry& geometry);

}  // namespace quadloop
