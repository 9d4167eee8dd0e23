#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <numbers>
#include <optional>
#include <set>
#include <span>

#include "io/files/reading/input_file.hpp"
#include "io/gis/dxf_drawing.hpp"
#include "io/gis/gdal_library.hpp"
#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "io/input/length_units.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

const GdalLibrary& gdal() { return GdalLibrary::instance(); }

/// GDAL handles, which are void pointers, with their release functions.
template <auto end>
struct End {
  void operator()(void* handle) const { (gdal().*end)(handle); }
};
using Dataset = std::unique_ptr<void, End<&GdalLibrary::GDALClose>>;
using Feature = std::unique_ptr<void, End<&GdalLibrary::OGR_F_Destroy>>;
using OwnGeometry = std::unique_ptr<void, End<&GdalLibrary::OGR_G_DestroyGeometry>>;

/// GDAL would call abort() when memory runs out. Other errors are kept as its last message.
void throw_out_of_memory(CPLErr kind, CPLErrorNum number, const char* message) {
  if (kind == CE_Fatal && number == CPLE_OutOfMemory) throw std::bad_alloc();
  gdal().CPLQuietErrorHandler(kind, number, message);
}

/// GDAL would print its own lines on stderr; its last message goes into ours instead. It gives each entity of
/// a DXF block as one feature with the entity's own layer, not one feature for a reference to the block.
class QuietGdal {
 public:
  QuietGdal() {
    gdal().CPLSetThreadLocalConfigOption("DXF_MERGE_BLOCK_GEOMETRIES", "FALSE");
    gdal().CPLPushErrorHandler(throw_out_of_memory);
    gdal().CPLErrorReset();
  }
  ~QuietGdal() { gdal().CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string without_blanks(std::string name) {
  for (char& c : name) c = std::string_view(" \t\r\n\v\f,#").find(c) != std::string_view::npos ? '_' : c;
  return name;
}

/// Returns an attribute, ignoring the case of its name; empty if the feature has none.
std::string text_of(OGRFeatureH feature, const char* attribute) {
  const int field = gdal().OGR_F_GetFieldIndex(feature, attribute);
  if (field < 0 || gdal().OGR_F_IsFieldSetAndNotNull(feature, field) == 0) return {};
  return gdal().OGR_F_GetFieldAsString(feature, field);
}

std::string name_of(OGRFeatureH feature, OGRLayerH layer) {
  for (const char* attribute : {"name", "boundary", "Layer"}) {
    const std::string name = text_of(feature, attribute);
    if (!name.empty()) return without_blanks(name);
  }
  return without_blanks(gdal().OGR_L_GetName(layer));
}

/// Counts omitted features by kind, for a warning.
class LeftOut {
 public:
  /// Features with the same handle count once: GDAL makes several features of a dimension.
  void add(const std::string& kind, const std::string& handle) {
    if (handle.empty() || seen_.insert(kind + handle).second) ++counts_[kind];
  }
  bool empty() const { return counts_.empty(); }
  std::string text() const {
    std::string text;
    for (const auto& [kind, count] : counts_)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
    return text;
  }

 private:
  std::map<std::string, std::int64_t> counts_;
  std::set<std::string> seen_;
};

/// Collects the chains of one feature after another.
class Collector {
 public:
  /// `drawing` is null if the file is not a drawing.
  Collector(std::vector<Chain>& chains, const LayerNames& layers, const DxfDrawing* drawing)
      : chains_{chains}, layers_{layers}, drawing_{drawing} {
    if (drawing == nullptr) return;
    known_layers_.insert(drawing->layers().begin(), drawing->layers().end());
    for (const auto& [block, layer] : drawing->missing_blocks()) {
      if (is_wanted(layer))
        left_out_.add(fmt::format("INSERT of block '{}', whose content is not in the file", block), {});
    }
  }

  void add_layer(OGRLayerH layer, const std::string& path) {
    if (drawing_ == nullptr) known_layers_.insert(gdal().OGR_L_GetName(layer));
    while (const Feature feature{gdal().OGR_L_GetNextFeature(layer)}) add_feature(feature.get(), layer, path);
  }

  const LeftOut& left_out() const { return left_out_; }
  const std::set<std::string>& known_layers() const { return known_layers_; }

 private:
  void add_feature(OGRFeatureH feature, OGRLayerH layer, const std::string& path) {
    const std::string layer_name = drawing_ ? text_of(feature, "Layer") : gdal().OGR_L_GetName(layer);
    known_layers_.insert(layer_name);
    if (!is_wanted(layer_name)) return;
    const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr) return;
    const std::string handle = drawing_ ? text_of(feature, "EntityHandle") : "";
    if (const std::string why = why_left_out(feature, handle, layer_name); !why.empty())
      return left_out_.add(why, handle);
    const std::string name = name_of(feature, layer);
    const std::string source = fmt::format("{}: layer '{}', feature {}", path, gdal().OGR_L_GetName(layer),
                                           gdal().OGR_F_GetFID(feature));
    const DxfEntity* const entity = drawing_ ? drawing_->find(handle) : nullptr;
    if (entity != nullptr && entity->spline) {
      if (std::vector<Point> points = points_of(*entity->spline); !points.empty())
        return add_points(std::move(points), name, source);
    }
    const OwnGeometry straight{gdal().OGR_G_HasCurveGeometry(geometry, 0) != 0
                                   ? gdal().OGR_G_GetLinearGeometry(geometry, 0, nullptr)
                                   : gdal().OGR_G_Clone(geometry)};
    add(straight.get(), name, source);
  }

  bool is_wanted(const std::string& layer) const {
    return layers_.empty() ||
           std::ranges::any_of(layers_, [&](const std::string& name) { return matches_layer(name, layer); });
  }

  /// For a drawing: returns the kind of a feature that is not part of the geometry, or not visible; empty if
  /// it is to be read.
  std::string why_left_out(OGRFeatureH feature, const std::string& handle, const std::string& layer) const {
    if (drawing_ == nullptr) return {};
    const std::string type = type_of(feature, handle);
    if (text_of(feature, "PaperSpace") == "1")
      return fmt::format("{} in paper space", type.empty() ? "entity" : type);
    const char* const style = gdal().OGR_F_GetStyleString(feature);
    const bool hidden = style != nullptr && has_hidden_colour(style);
    if (hidden && layers_.empty())
      return fmt::format("{} not visible on layer '{}'", type.empty() ? "entity" : type, layer);
    return is_outline(type) ? std::string() : fmt::format("{} on layer '{}'", type, layer);
  }

  /// Returns the entity's type; for the contents of a block its class.
  std::string type_of(OGRFeatureH feature, const std::string& handle) const {
    const DxfEntity* const entity = drawing_->find(handle);
    if (entity != nullptr && entity->type != "INSERT") return entity->type;
    const std::string classes = text_of(feature, "SubClasses");
    return classes.substr(classes.rfind(':') + 1);
  }

  static bool is_outline(const std::string& type) {
    static const std::set<std::string> types{"",         "LINE",         "LWPOLYLINE",     "POLYLINE",
                                             "ARC",      "CIRCLE",       "ELLIPSE",        "SPLINE",
                                             "AcDbLine", "AcDbPolyline", "AcDb2dPolyline", "AcDb3dPolyline",
                                             "AcDbArc",  "AcDbCircle",   "AcDbEllipse",    "AcDbSpline"};
    return types.contains(type);
  }

  /// GDAL gives features on a layer that is off or frozen, and invisible ones, a transparent colour.
  static bool has_hidden_colour(std::string_view style) {
    const std::size_t colour = style.find("c:#");
    return colour != std::string_view::npos && style.substr(colour + 3, 8).size() == 8 &&
           style.substr(colour + 9, 2) == "00";
  }

  void add(OGRGeometryH geometry, const std::string& name, const std::string& source) {
    const OGRwkbGeometryType type = gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
    if (type == wkbLineString || type == wkbLinearRing) {
      add_line(geometry, name, source);
    } else if (type == wkbPolygon || gdal().OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
      const int parts = gdal().OGR_G_GetGeometryCount(geometry);
      for (int i = 0; i < parts; ++i) add(gdal().OGR_G_GetGeometryRef(geometry, i), name, source);
    } else {
      left_out_.add("features that are neither lines nor polygons", {});
    }
  }

  void add_line(OGRGeometryH line, const std::string& name, const std::string& source) {
    std::vector<Point> read;
    const int points = gdal().OGR_G_GetPointCount(line);
    for (int i = 0; i < points; ++i) read.push_back({gdal().OGR_G_GetX(line, i), gdal().OGR_G_GetY(line, i)});
    add_points(std::move(read), name, source);
  }

  void add_points(std::vector<Point> points, const std::string& name, const std::string& source) {
    if (points.empty()) return;
    Chain chain{name, true, std::move(points), source, false};
    if (chain.points.size() > 2 && chain.points.front() == chain.points.back()) {
      chain.points.pop_back();
      chain.open = false;
    }
    chains_.push_back(std::move(chain));
  }

  std::vector<Chain>& chains_;
  const LayerNames& layers_;
  const DxfDrawing* drawing_;
  LeftOut left_out_;
  std::set<std::string> known_layers_;
};

/// Whether a box may be in longitudes and latitudes: some programs write metres to files that declare
/// degrees.
bool are_degrees(const Box& box) {
  return box.low.x >= -360 && box.high.x <= 360 && box.low.y >= -90 && box.high.y <= 90;
}

/// Returns the code of the UTM zone (6 degrees wide) of the box's centre.
int utm_code(Point middle) {
  const int zone = std::clamp(static_cast<int>(std::floor((middle.x + 180) / 6)) + 1, 1, 60);
  return (middle.y >= 0 ? 32600 : 32700) + zone;
}

/// Lengths in degrees are seldom intended: spacings would be in degrees, and cells too narrow along x.
void warn_of_degrees(const std::string& path, std::span<const Chain> chains,
                     std::vector<std::string>& warnings) {
  Box box;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) box.include(p);
  }
  if (chains.empty() || !are_degrees(box)) return;
  const Point middle = box.centre();
  const std::string name = std::filesystem::path(path).filename().string();
  warnings.push_back(
      fmt::format("{}: its coordinates are degrees (longitude, latitude), and so all lengths of the case "
                  "are; at latitude {:.1f} a degree "
                  "along x is {:.2f} of one along y. Project it first, as by 'ogr2ogr -t_srs EPSG:{} "
                  "projected.gpkg {}' (metres)",
                  path, middle.y, std::cos(middle.y * std::numbers::pi / 180), utm_code(middle), name));
}

bool is_in_degrees(OGRLayerH layer) {
  const OGRSpatialReferenceH reference = gdal().OGR_L_GetSpatialRef(layer);
  return reference != nullptr && gdal().OSRIsGeographic(reference) != 0;
}

/// Records the unit of a projected map; none if layers have different units.
void note_unit(OGRLayerH layer, FileUnit& unit) {
  const OGRSpatialReferenceH reference = gdal().OGR_L_GetSpatialRef(layer);
  if (reference == nullptr || gdal().OSRIsGeographic(reference) != 0) return;
  char* name = nullptr;
  const double metres = gdal().OSRGetLinearUnits(reference, &name);
  if (unit.metres != 0 && unit.metres != metres)
    unit = {};
  else
    unit = {name, metres, {}};
}

void read_layer(OGRLayerH layer, const std::string& path, Collector& collector) {
  collector.add_layer(layer, path);
  if (gdal().CPLGetLastErrorType() >= CE_Failure)
    throw InputError(fmt::format("{}: {}; correct the file or export it again", path,
                                 one_line(gdal().CPLGetLastErrorMsg())));
}

/// A file in memory, for GDAL.
class MemoryFile {
 public:
  explicit MemoryFile(std::string text) : text_{std::move(text)} {
    gdal().VSIFCloseL(
        gdal().VSIFileFromMemBuffer(name, reinterpret_cast<GByte*>(text_.data()), text_.size(), 0));
  }
  ~MemoryFile() { gdal().VSIUnlink(name); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  static constexpr const char* name = "/vsimem/corrected.dxf";

 private:
  std::string text_;
};

void refuse_empty(const std::string& path, const LayerNames& layers, const Collector& collector) {
  const std::vector<std::string> known(collector.known_layers().begin(), collector.known_layers().end());
  if (!layers.empty() && collector.left_out().empty())
    throw InputError(
        fmt::format("{}: no layer of the file has lines or polygons and is one of [{}]; its layers are: {}",
                    path, fmt::join(layers, ", "), first_few(known)));
  throw InputError(
      fmt::format("{}: holds no lines and no polygons; a geometry needs closed outlines{}", path,
                  collector.left_out().empty() ? "" : ". Left out: " + collector.left_out().text()));
}

}  // namespace

std::vector<Chain> read_ogr(const std::string& path, const LayerNames& layers,
                            std::vector<std::string>& warnings, FileUnit& unit) {
  require_input_file(path);
  std::optional<DxfDrawing> drawing;
  if (suffix_of(path) == ".dxf") drawing.emplace(path);
  gdal().GDALAllRegister();
  const QuietGdal quiet;
  std::optional<MemoryFile> corrected;
  if (drawing && !drawing->corrected().empty()) corrected.emplace(drawing->corrected());
  const Dataset data{gdal().GDALOpenEx(corrected ? MemoryFile::name : path.c_str(),
                                       GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)};
  if (!data) {
    throw InputError(
        fmt::format("{}: cannot be read as the kind of file that its suffix indicates ({}); export it again",
                    path, one_line(gdal().CPLGetLastErrorMsg())));
  }
  std::vector<Chain> chains;
  Collector collector(chains, layers, drawing ? &*drawing : nullptr);
  gdal().CPLErrorReset();
  std::vector<Chain> in_degrees;
  for (int i = 0; i < gdal().GDALDatasetGetLayerCount(data.get()); ++i) {
    const OGRLayerH layer = gdal().GDALDatasetGetLayer(data.get(), i);
    const auto before = std::ssize(chains);
    read_layer(layer, path, collector);
    if (!drawing) note_unit(layer, unit);
    if (is_in_degrees(layer)) in_degrees.insert(in_degrees.end(), chains.begin() + before, chains.end());
  }
  if (chains.empty()) refuse_empty(path, layers, collector);
  warn_of_degrees(path, in_degrees, warnings);
  if (!collector.left_out().empty())
    warnings.push_back(fmt::format("{}: left out: {}", path, collector.left_out().text()));
  if (drawing && !drawing->unit().empty())
    unit = {drawing->unit(), metres_in(drawing->unit()).value_or(0), {}};
  unit.layers.assign(collector.known_layers().begin(), collector.known_layers().end());
  return chains;
}

void add_gis_formats() {
  for (const std::string& suffix : gis_suffixes) add_geometry_reader(suffix, read_ogr);
}

}  // namespace quadloop::io
