#include <map>

#include "io/msh/msh_solid_file.hpp"
#include "io/msh/msh_text.hpp"
#include "io/solid/block_collector.hpp"

namespace quadloop {

namespace {

class MshSolidReader {
 public:
  explicit MshSolidReader(const std::string& path) : text_{path, 3} {}

  std::optional<SolidMesh> read() {
    text_.read([this](std::int64_t, Point3 point) { mesh_.points.push_back(point); },
               [this](const MshElement& element) { put_element(element); });
    if (cells() == 0) return std::nullopt;
    if (text_.may_repeat()) drop_repeated_cells();
    if (!text_.read_values().empty())
      mesh_.warnings.push_back(text_.scan().path() +
                               ": of three dimensions its solution ($NodeData, $ElementData) is not read");
    blocks_.put_into(mesh_);
    return std::move(mesh_);
  }

 private:
  std::size_t cells() const {
    return mesh_.tetrahedra.size() + mesh_.pyramids.size() + mesh_.prisms.size() + mesh_.hexahedra.size();
  }

  void put_element(const MshElement& element) {
    switch (element.type) {
      case msh_triangle: {
        const auto n = element.as<std::int32_t, 3>();
        patch_of(element).faces.push_back({n[0], n[1], n[2], SolidPatch::no_node});
        break;
      }
      case msh_quad: patch_of(element).faces.push_back(element.as<std::int32_t, 4>()); break;
      case msh_tetrahedron: add(mesh_.tetrahedra, element); break;
      case msh_pyramid: add(mesh_.pyramids, element); break;
      case msh_prism: add(mesh_.prisms, element); break;
      case msh_hexahedron: add(mesh_.hexahedra, element); break;
      default: break;
    }
  }

  template <std::size_t width>
  void add(std::vector<std::array<std::int32_t, width>>& cells, const MshElement& element) {
    cells.push_back(element.as<std::int32_t, width>());
    const auto [volume, is_new] = volumes_.try_emplace(std::abs(element.physical), 0);
    if (is_new)
      volume->second =
          blocks_.named(volume->first == 0 ? "domain" : text_.groups().name_of(3, volume->first));
    blocks_.take(mesh_, volume->second);
  }

  SolidPatch& patch_of(const MshElement& element) {
    const std::pair key{std::abs(element.physical), element.physical == 0 ? element.entity : 0};
    const auto [found, is_new] = patches_.try_emplace(key, mesh_.patches.size());
    if (is_new)
      mesh_.patches.push_back({key.first == 0 ? "boundary_" + std::to_string(element.entity)
                                              : text_.groups().name_of(2, key.first),
                               "none",
                               {}});
    return mesh_.patches[found->second];
  }

  /// A cell in several groups stands there once for each, one after another in the order of the groups: it is
  /// of the first.
  void drop_repeated_cells() {
    if (volumes_.size() < 2) return;
    for_each_kind_of_cell([&]<std::size_t width>() {
      auto& cells = cells_of<width>(mesh_);
      std::map<std::array<std::int32_t, width>, bool> seen;
      std::vector<char> again;
      for (const auto& cell : cells) again.push_back(seen.try_emplace(cell, true).second ? 0 : 1);
      drop(blocks_.of<width>(), again);
      drop(cells, again);
    });
  }

  template <class Row>
  static void drop(std::vector<Row>& rows, const std::vector<char>& flags) {
    std::size_t i = 0;
    std::erase_if(rows, [&](const Row&) { return flags[i++] != 0; });
  }

  MshText text_;
  SolidMesh mesh_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> patches_;  ///< by group, or surface
  std::map<std::int64_t, std::int32_t> volumes_;                          ///< by group their blocks
  BlockCollector blocks_;
};

}  // namespace

std::optional<SolidMesh> read_msh_solid(const std::string& path) { return MshSolidReader(path).read(); }

}  // namespace quadloop
