#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "io/fluent/fluent_sections.hpp"
#include "io/fluent/fluent_solid_file.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/solid/block_collector.hpp"
#include "io/solid/cell_of_sides.hpp"

namespace quadloop {

namespace {

class FluentSolidReader {
 public:
  explicit FluentSolidReader(const std::string& path) : file_{path, 3} {}

  SolidMesh read() {
    mesh_.points = file_.points();
    const std::vector<std::int64_t> zone_of = file_.zones_of_cells();
    for (std::int32_t cell = 1; cell <= file_.cells(); ++cell) add(cell, zone_of[cell]);
    blocks_.put_into(mesh_);
    add_patches();
    return std::move(mesh_);
  }

 private:
  void add(std::int32_t cell, std::int64_t zone) {
    std::vector<CellSide> sides;
    for (const std::int32_t f : file_.faces_of(cell)) {
      const FluentFace& face = file_.faces()[f];
      sides.push_back({face.nodes, face.cells[0] != cell});
    }
    if (const std::string fault = add_cell(mesh_, sides); !fault.empty())
      file_.scan().refuse_at(sides.empty() ? 0 : file_.faces()[file_.faces_of(cell)[0]].place,
                             fmt::format("cell {} {}", cell, fault));
    blocks_.take(mesh_, blocks_.named(file_.block_name(zone)));
  }

  /// Faces of a zone that have one cell; turned so that they look out of it.
  void add_patches() {
    std::map<std::string, std::size_t> patches;
    for (const FluentFace& face : file_.faces()) {
      if (face.is_inside()) continue;
      const auto [found, is_new] = patches.try_emplace(file_.zone_name(face.zone), mesh_.patches.size());
      if (is_new) mesh_.patches.push_back({found->first, condition_of_fluent(face.type), {}});
      SolidPatch::Face nodes = face.nodes;
      const auto corners = nodes.begin() + (nodes[3] == SolidPatch::no_node ? 3 : 4);
      if (face.cells[0] != 0) std::reverse(nodes.begin(), corners);
      mesh_.patches[found->second].faces.push_back(nodes);
    }
  }

  FluentSections file_;
  SolidMesh mesh_;
  BlockCollector blocks_;
};

}  // namespace

std::optional<SolidMesh> read_fluent_solid(const std::string& path) {
  if (fluent_dimension(path) != 3) return std::nullopt;
  return FluentSolidReader(path).read();
}

}  // namespace quadloop
