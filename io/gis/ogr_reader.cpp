#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <numbers>
#include <set>
#include <span>

#include "io/files/reading/input_file.hpp"
#include "io/gis/gdal_library.hpp"
#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/base/error.hpp"

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

/// GDAL would print its own lines on stderr; its last message goes into ours instead.
class QuietGdal {
 public:
  QuietGdal() {
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

/// Returns an attribute, ignoring the case of its name; empty if the feature has none.
std::string text_of(OGRFeatureH feature, const char* attribute) {
  const int field = gdal().OGR_F_GetFieldIndex(feature, attribute);
  if (field < 0 || gdal().OGR_F_IsFieldSetAndNotNull(feature, field) == 0) return {};
  return gdal().OGR_F_GetFieldAsString(feature, field);
}

/// Collects the chains of one feature after another.
class Collector {
 public:
  Collector(std::vector<Chain>& chains, const DrawingChoice& choice, const std::string& path)
      : chains_{chains}, choice_{choice}, path_{path} {}

  void add_layer(OGRLayerH layer) {
    const std::string name = gdal().OGR_L_GetName(layer);
    known_layers_.insert(name);
    if (!choice_.has_layer(name)) return;
    while (const Feature feature{gdal().OGR_L_GetNextFeature(layer)}) add_feature(feature.get(), name);
  }

  const LeftOut& left_out() const { return left_out_; }
  std::vector<std::string> known_layers() const { return {known_layers_.begin(), known_layers_.end()}; }

 private:
  void add_feature(OGRFeatureH feature, const std::string& layer) {
    const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr) return;
    const std::string source =
        fmt::format("{}: layer '{}', feature {}", path_, layer, gdal().OGR_F_GetFID(feature));
    const OwnGeometry straight{gdal().OGR_G_HasCurveGeometry(geometry, 0) != 0
                                   ? gdal().OGR_G_GetLinearGeometry(geometry, 0, nullptr)
                                   : gdal().OGR_G_Clone(geometry)};
    add(straight.get(), one_word(name_of(feature, layer)), source);
  }

  std::string name_of(OGRFeatureH feature, const std::string& layer) const {
    using From = BoundaryNames::From;
    const auto& [from, attribute] = choice_.names;
    if (from == From::file) return std::filesystem::path(path_).stem().string();
    std::vector<std::string> attributes;
    if (from == From::attribute) attributes = {attribute};
    if (from == From::usual) attributes = {"name", "boundary"};
    for (const std::string& name : attributes) {
      if (std::string text = text_of(feature, name.c_str()); !text.empty()) return text;
    }
    return layer;
  }

  void add(OGRGeometryH geometry, const std::string& name, const std::string& source) {
    const OGRwkbGeometryType type = gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
    if (type == wkbLineString || type == wkbLinearRing) {
      add_line(geometry, name, source);
    } else if (type == wkbPolygon || gdal().OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
      const int parts = gdal().OGR_G_GetGeometryCount(geometry);
      for (int i = 0; i < parts; ++i) add(gdal().OGR_G_GetGeometryRef(geometry, i), name, source);
    } else {
      left_out_.add("features that are neither lines nor polygons");
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
  const DrawingChoice& choice_;
  const std::string& path_;
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
  collector.add_layer(layer);
  if (gdal().CPLGetLastErrorType() >= CE_Failure)
    throw InputError(fmt::format("{}: {}; correct the file or export it again", path,
                                 one_line(gdal().CPLGetLastErrorMsg())));
}

}  // namespace

std::vector<Chain> read_ogr(const std::string& path, const DrawingChoice& choice,
                            std::vector<std::string>& warnings, FileUnit& unit) {
  require_input_file(path);
  gdal().GDALAllRegister();
  const QuietGdal quiet;
  const Dataset data{
      gdal().GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)};
  if (!data) {
    throw InputError(
        fmt::format("{}: cannot be read as the kind of file that its suffix indicates ({}); export it again",
                    path, one_line(gdal().CPLGetLastErrorMsg())));
  }
  std::vector<Chain> chains;
  Collector collector(chains, choice, path);
  gdal().CPLErrorReset();
  std::vector<Chain> in_degrees;
  for (int i = 0; i < gdal().GDALDatasetGetLayerCount(data.get()); ++i) {
    const OGRLayerH layer = gdal().GDALDatasetGetLayer(data.get(), i);
    const auto before = std::ssize(chains);
    read_layer(layer, path, collector);
    note_unit(layer, unit);
    if (is_in_degrees(layer)) in_degrees.insert(in_degrees.end(), chains.begin() + before, chains.end());
  }
  unit.layers = collector.known_layers();
  if (chains.empty()) refuse_empty(path, choice, unit.layers, collector.left_out());
  warn_of_degrees(path, in_degrees, warnings);
  if (!collector.left_out().empty())
    warnings.push_back(fmt::format("{}: left out: {}", path, collector.left_out().text()));
  return chains;
}

void add_gis_formats() {
  for (const std::string& suffix : gis_suffixes) add_geometry_reader(suffix, read_ogr);
}

}  // namespace quadloop::io
