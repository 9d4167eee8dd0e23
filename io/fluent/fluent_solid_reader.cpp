#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "io/fluent/fluent_sections.hpp"
#include "io/fluent/fluent_solid_file.hpp"
#include "io/fluent/fluent_zones.hpp"
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
    collect_blocks();
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
    const std::array before = counts();
    if (const std::string fault = add_cell(mesh_, sides); !fault.empty())
      file_.scan().refuse_at(sides.empty() ? 0 : file_.faces()[file_.faces_of(cell)[0]].place,
                             fmt::format("cell {} {}", cell, fault));
    const auto [block, is_new] = blocks_.try_emplace(file_.block_name(zone), std::ssize(blocks_));
    if (is_new) mesh_.block_names.push_back(block->first);
    const std::array after = counts();
    for (std::size_t kind = 0; kind < after.size(); ++kind) {
      if (after[kind] > before[kind]) of_kind_[kind].push_back(block->second);
    }
  }

  std::array<std::size_t, 4> counts() const {
    return {mesh_.tetrahedra.size(), mesh_.pyramids.size(), mesh_.prisms.size(), mesh_.hexahedra.size()};
  }

  void collect_blocks() {
    if (blocks_.size() < 2) return mesh_.block_names.clear();
    for (const std::vector<std::int32_t>& blocks : of_kind_)
      mesh_.cell_to_block.insert(mesh_.cell_to_block.end(), blocks.begin(), blocks.end());
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
  std::map<std::string, std::int32_t> blocks_;
  std::array<std::vector<std::int32_t>, 4> of_kind_;  ///< blocks of tetrahedra, pyramids, prisms, hexahedra
};

}  // namespace

std::optional<SolidMesh> read_fluent_solid(const std::string& path) {
  if (fluent_dimension(path) != 3) return std::nullopt;
  return FluentSolidReader(path).read();
}

}  // namespace quadloop
