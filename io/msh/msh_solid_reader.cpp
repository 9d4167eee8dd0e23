#include <map>

#include "io/loaded/repeated_rows.hpp"
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
    if (text_.may_repeat()) drop_repeated();
    for (const std::string& warning : text_.warnings(2)) mesh_.warnings.push_back(warning);
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

  /// An element in several groups stands there once for each; it is of the smallest.
  void drop_repeated() {
    RepeatedElements repeated;
    const std::vector<std::int64_t> sizes = block_sizes();
    for_each_kind_of_cell([&]<std::size_t width>() {
      auto& cells = cells_of<width>(mesh_);
      std::vector<std::int32_t>& blocks = blocks_.of<width>();
      const auto kept = kept_rows(
          cells, [](const auto& nodes) { return nodes; }, [&](std::size_t i) { return sizes[blocks[i]]; });
      for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] != i) ++repeated[{blocks_.name(blocks[kept[i]]), blocks_.name(blocks[i])}];
      }
      keep_rows(blocks, kept);
      keep_rows(cells, kept);
    });
    drop_repeated_faces(repeated);
    warn_of_repeated(repeated, text_.scan().path(), mesh_.warnings);
  }

  void drop_repeated_faces(RepeatedElements& repeated) {
    std::vector<SolidPatch::Face> faces;
    std::vector<std::size_t> patch_of;
    for (std::size_t patch = 0; patch < mesh_.patches.size(); ++patch) {
      auto& own = mesh_.patches[patch].faces;
      faces.insert(faces.end(), own.begin(), own.end());
      patch_of.resize(faces.size(), patch);
    }
    const std::vector<std::int64_t> sizes = patch_sizes();
    const auto kept = kept_rows(
        faces, [](const SolidPatch::Face& face) { return face; },
        [&](std::size_t i) { return sizes[patch_of[i]]; });
    for (SolidPatch& patch : mesh_.patches) patch.faces.clear();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (kept[i] == i) {
        mesh_.patches[patch_of[i]].faces.push_back(faces[i]);
      } else {
        ++repeated[{mesh_.patches[patch_of[kept[i]]].name, mesh_.patches[patch_of[i]].name}];
      }
    }
    std::erase_if(mesh_.patches, [](const SolidPatch& patch) { return patch.faces.empty(); });
  }

  /// How many volumes or surfaces the groups of blocks and of patches have.
  std::vector<std::int64_t> block_sizes() const {
    std::vector<std::int64_t> sizes;
    for (const auto& [physical, block] : volumes_) {
      if (block >= std::ssize(sizes)) sizes.resize(block + 1, 0);
      sizes[block] += text_.groups().members_of(3, physical);
    }
    return sizes;
  }
  std::vector<std::int64_t> patch_sizes() const {
    std::vector<std::int64_t> sizes(mesh_.patches.size(), 0);
    for (const auto& [key, patch] : patches_) sizes[patch] = text_.groups().members_of(2, key.first);
    return sizes;
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
