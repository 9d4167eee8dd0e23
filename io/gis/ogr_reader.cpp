#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <numbers>
#include <span>

#include "io/files/input_file.hpp"
#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Where memory ends GDAL would call abort(). All else it keeps as its last message.
void throw_out_of_memory(CPLErr kind, CPLErrorNum number, const char* message) {
  if (kind == CE_Fatal && number == CPLE_OutOfMemory) throw std::bad_alloc();
  CPLQuietErrorHandler(kind, number, message);
}

/// GDAL would print its own lines on stderr; its last message goes into ours instead.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(throw_out_of_memory);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
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

std::string name_of(const OGRFeature& feature, const OGRLayer& layer) {
  for (const char* attribute : {"boundary", "name", "Layer"}) {
    const int field = feature.GetFieldIndex(attribute);  // in any case
    if (field < 0 || !feature.IsFieldSetAndNotNull(field)) continue;
    const std::string name = feature.GetFieldAsString(field);
    if (!name.empty()) return without_blanks(name);
  }
  return without_blanks(const_cast<OGRLayer&>(layer).GetName());
}

/// Gathers the chains of one feature after another.
class Collector {
 public:
  explicit Collector(std::vector<Chain>& chains) : chains_{chains} {}

  void add(const OGRGeometry& geometry, const std::string& name, const std::string& source) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbLineString || type == wkbLinearRing) {
      add_line(*geometry.toLineString(), name, source);
    } else if (type == wkbPolygon) {
      for (const OGRLinearRing* ring : *geometry.toPolygon()) add_line(*ring, name, source);
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) add(*part, name, source);
    } else {
      ++left_out_;
    }
  }
  std::int64_t left_out() const { return left_out_; }

 private:
  void add_line(const OGRSimpleCurve& line, const std::string& name, const std::string& source) {
    Chain chain{name, true, {}, source};
    for (int i = 0; i < line.getNumPoints(); ++i) chain.points.push_back({line.getX(i), line.getY(i)});
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

bool is_in_degrees(const OGRLayer& layer) {
  const OGRSpatialReference* reference = const_cast<OGRLayer&>(layer).GetSpatialRef();
  return reference != nullptr && reference->IsGeographic() != 0;
}

void read_layer(OGRLayer& layer, const std::string& path, Collector& collector) {
  while (const auto feature = std::unique_ptr<OGRFeature>(layer.GetNextFeature())) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr) continue;
    const auto straight = std::unique_ptr<OGRGeometry>(
        geometry->hasCurveGeometry() ? geometry->getLinearGeometry() : geometry->clone());
    const std::string source =
        fmt::format("{}: layer '{}', feature {}", path, layer.GetName(), feature->GetFID());
    collector.add(*straight, name_of(*feature, layer), source);
  }
  if (CPLGetLastErrorType() >= CE_Failure)
    throw InputError(
        fmt::format("{}: {}; correct or export the file anew", path, one_line(CPLGetLastErrorMsg())));
}

}  // namespace

std::vector<Chain> read_ogr(const std::string& path, std::vector<std::string>& warnings) {
  require_input_file(path);
  GDALAllRegister();
  const QuietGdal quiet;
  const GDALDatasetUniquePtr data(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!data) {
    throw InputError(
        fmt::format("{}: cannot be read as the kind of file that its suffix says ({}); export it anew", path,
                    one_line(CPLGetLastErrorMsg())));
  }
  std::vector<Chain> chains;
  Collector collector(chains);
  CPLErrorReset();
  std::vector<Chain> in_degrees;
  for (OGRLayer* layer : data->GetLayers()) {
    const auto before = std::ssize(chains);
    read_layer(*layer, path, collector);
    if (is_in_degrees(*layer)) in_degrees.insert(in_degrees.end(), chains.begin() + before, chains.end());
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
