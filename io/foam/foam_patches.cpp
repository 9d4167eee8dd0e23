#include "io/foam/foam_patches.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/foam/foam_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

FoamPatch read_patch(FoamScanner& scan) {
  FoamPatch patch;
  patch.name = scan.token("the name of a patch");
  scan.expect("{");
  for (std::string key(scan.token("}")); key != "}"; key = scan.token("}")) {
    if (key == "nFaces") {
      patch.faces = scan.integer("a number of faces");
    } else if (key == "startFace") {
      patch.first_face = scan.integer("the number of a face");
    } else if (key == "type") {
      patch.type = scan.token("the type of a patch");
    } else if (key == "physicalType") {
      patch.physical_type = scan.token("the physical type of a patch");
    }
    while (scan.token(";") != ";") {
    }
  }
  return patch;
}

std::int32_t read_cell(FoamScanner& scan, std::int64_t end) {
  const std::int64_t cell = scan.integer("the number of a cell");
  if (cell < 0 || cell >= end)
    scan.refuse(fmt::format("cell {} is none of the cells 0 to {}", cell, end - 1));
  return static_cast<std::int32_t>(cell);
}

/// "NAME { type cellZone; cellLabels List<label> 3 (0 1 2); }"; an empty list is "0".
FoamZone read_zone(FoamScanner& scan, std::int64_t end) {
  FoamZone zone;
  zone.name = scan.token("the name of a zone");
  scan.expect("{");
  for (std::string key(scan.token("}")); key != "}"; key = scan.token("}")) {
    if (key != "cellLabels") {
      while (scan.token(";") != ";") {
      }
      continue;
    }
    scan.expect("List<label>");
    for (std::size_t left = scan.begin_list("cells of a zone", 2); left > 0; --left)
      zone.cells.push_back(read_cell(scan, end));
    scan.expect(")");
    scan.expect(";");
  }
  return zone;
}

}  // namespace

BoundaryCondition condition_of_foam_type(std::string_view type) {
  if (type == "wall") return BoundaryCondition::wall;
  return type.starts_with("symmetry") || type == "empty" ? BoundaryCondition::symmetry
                                                         : BoundaryCondition::none;
}

std::vector<FoamZone> read_foam_zones(const std::string& path, std::int64_t end) {
  FoamScanner scan(path);
  std::vector<FoamZone> zones;
  for (std::size_t left = scan.begin_list("zones", 4); left > 0; --left)
    zones.push_back(read_zone(scan, end));
  scan.end_file();
  return zones;
}

std::vector<FoamPatch> read_foam_boundary(const std::string& path) {
  FoamScanner scan(path);
  std::vector<FoamPatch> patches;
  for (std::size_t left = scan.begin_list("patches", 4); left > 0; --left)
    patches.push_back(read_patch(scan));
  scan.end_file();
  return patches;
}

std::vector<std::int32_t> read_foam_labels(const std::string& path, std::int64_t end) {
  FoamScanner scan(path);
  std::vector<std::int32_t> labels;
  for (std::size_t left = scan.begin_list("cells of faces", 2); left > 0; --left)
    labels.push_back(read_cell(scan, end));
  scan.end_file();
  return labels;
}

std::vector<FoamPatch> read_foam_patches(const std::string& folder, std::int64_t cells) {
  const std::filesystem::path path = folder;
  const std::vector<std::int32_t> owner = read_foam_labels((path / "owner").string(), cells);
  std::vector<FoamPatch> patches = read_foam_boundary((path / "boundary").string());
  for (FoamPatch& patch : patches) {
    if (patch.faces < 0 || patch.first_face < 0 || patch.first_face + patch.faces > std::ssize(owner))
      throw InputError(fmt::format("{}: patch {} is of {} faces from {} on, of which there are {}", folder,
                                   patch.name, patch.faces, patch.first_face, owner.size()));
    const auto first = owner.begin() + patch.first_face;
    patch.cells.assign(first, first + patch.faces);
  }
  return patches;
}

}  // namespace quadloop::io
