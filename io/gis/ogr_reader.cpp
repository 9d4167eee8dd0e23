#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <numbers>
#include <span>

#include "io/files/reading/input_file.hpp"
#include "io/gis/gdal_library.hpp"
#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

const GdalLibrary& gdal() { return GdalLibrary::instance(); }

/// Handles of GDAL's, which are pointers to void, each with the function that ends it.
template <auto end>
struct End {
  void operator()(void* handle) const { (gdal().*end)(handle); }
};
using Dataset = std::unique_ptr<void, End<&GdalLibrary::GDALClose>>;
using Feature = std::unique_ptr<void, End<&GdalLibrary::OGR_F_Destroy>>;
using OwnGeometry = std::unique_ptr<void, End<&GdalLibrary::OGR_G_DestroyGeometry>>;

/// Where memory ends GDAL would call abort(). All else it keeps as its last message.
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

std::string without_blanks(std::string name) {
  for (char& c : name) c = std::string_view(" \t\r\n\v\f,#").find(c) != std::string_view::npos ? '_' : c;
  return name;
}

std::string name_of(OGRFeatureH feature, OGRLayerH layer) {
  for (const char* attribute : {"boundary", "name", "Layer"}) {
    const int field = gdal().OGR_F_GetFieldIndex(feature, attribute);  // in any case
    if (field < 0 || gdal().OGR_F_IsFieldSetAndNotNull(feature, field) == 0) continue;
    const std::string name = gdal().OGR_F_GetFieldAsString(feature, field);
    if (!name.empty()) return without_blanks(name);
  }
  return without_blanks(gdal().OGR_L_GetName(layer));
}

/// Gathers the chains of one feature after another.
class Collector {
 public:
  explicit Collector(std::vector<Chain>& chains) : chains_{chains} {}

  void add(OGRGeometryH geometry, const std::string& name, const std::string& source) {
    const OGRwkbGeometryType type = gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
    if (type == wkbLineString || type == wkbLinearRing) {
      add_line(geometry, name, source);
    } else if (type == wkbPolygon || gdal().OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
      const int parts = gdal().OGR_G_GetGeometryCount(geometry);
      for (int i = 0; i < parts; ++i) add(gdal().OGR_G_GetGeometryRef(geometry, i), name, source);
    } else {
      ++left_out_;
    }
  }
  std::int64_t left_out() const { return left_out_; }

 private:
  void add_line(OGRGeometryH line, const std::string& name, const std::string& source) {
    Chain chain{name, true, {}, source};
    const int points = gdal().OGR_G_GetPointCount(line);
    for (int i = 0; i < points; ++i)
      chain.points.push_back({gdal().OGR_G_GetX(line, i), gdal().OGR_G_GetY(line, i)});
    if (chain.points.empty()) return;
    if (chain.points.size() > 2 && chain.points.front() == chain.points.back()) {
      chain.points.pop_back();
      chain.open = false;
    }
    chains_.push_back(std::move(chain));
  }

  std::vector<Chain>& chains_;
  std::int64_t left_out_ = 0;
};

/// A box of longitudes and latitudes, if it can be one: some programs write metres into files that declare
/// degrees.
bool are_degrees(const Box& box) {
  return box.low.x >= -360 && box.high.x <= 360 && box.low.y >= -90 && box.high.y <= 90;
}

/// The projection for the zone of 6 degrees that the box's middle lies in (UTM).
int utm_code(Point middle) {
  const int zone = std::clamp(static_cast<int>(std::floor((middle.x + 180) / 6)) + 1, 1, 60);
  return (middle.y >= 0 ? 32600 : 32700) + zone;
}

/// Lengths in degrees are seldom meant: a spacing would be in degrees, and cells too narrow along x.
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

void read_layer(OGRLayerH layer, const std::string& path, Collector& collector) {
  while (const Feature feature{gdal().OGR_L_GetNextFeature(layer)}) {
    const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(feature.get());
    if (geometry == nullptr) continue;
    const OwnGeometry straight{gdal().OGR_G_HasCurveGeometry(geometry, 0) != 0
                                   ? gdal().OGR_G_GetLinearGeometry(geometry, 0, nullptr)
                                   : gdal().OGR_G_Clone(geometry)};
    const std::string source = fmt::format("{}: layer '{}', feature {}", path, gdal().OGR_L_GetName(layer),
                                           gdal().OGR_F_GetFID(feature.get()));
    collector.add(straight.get(), name_of(feature.get(), layer), source);
  }
  if (gdal().CPLGetLastErrorType() >= CE_Failure)
    throw InputError(
        fmt::format("{}: {}; correct or export the file anew", path, one_line(gdal().CPLGetLastErrorMsg())));
}

}  // namespace

std::vector<Chain> read_ogr(const std::string& path, std::vector<std::string>& warnings) {
  require_input_file(path);
  gdal().GDALAllRegister();
  const QuietGdal quiet;
  const Dataset data{
      gdal().GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)};
  if (!data) {
    throw InputError(
        fmt::format("{}: cannot be read as the kind of file that its suffix says ({}); export it anew", path,
                    one_line(gdal().CPLGetLastErrorMsg())));
  }
  std::vector<Chain> chains;
  Collector collector(chains);
  gdal().CPLErrorReset();
  std::vector<Chain> in_degrees;
  for (int i = 0; i < gdal().GDALDatasetGetLayerCount(data.get()); ++i) {
    const OGRLayerH layer = gdal().GDALDatasetGetLayer(data.get(), i);
    const auto before = std::ssize(chains);
    read_layer(layer, path, collector);
    if (is_in_degrees(layer)) in_degrees.insert(in_degrees.end(), chains.begin() + before, chains.end());
  }
  if (chains.empty())
    throw InputError(path + ": holds no lines and no polygons; a geometry needs closed outlines");
  warn_of_degrees(path, in_degrees, warnings);
  if (collector.left_out() > 0) {
    warnings.push_back(fmt::format("{}: left out {} features that are neither lines nor polygons", path,
                                   collector.left_out()));
  }
  return chains;
}

void add_gis_formats() {
  for (const std::string& suffix : gis_suffixes) add_geometry_reader(suffix, read_ogr);
}

}  // namespace quadloop
