#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// The blocks of a 3D mesh that is being read, cell by cell in any order of their kinds.
class BlockCollector {
 public:
  /// The block of this name, made where there is none yet.
  std::int32_t named(const std::string& name) {
    const auto [found, is_new] = numbers_.try_emplace(name, static_cast<std::int32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return found->second;
  }

  const std::string& name(std::int32_t block) const { return names_[block]; }

  /// The cells that the mesh has got since the last call are of this block.
  void take(const SolidMesh& mesh, std::int32_t block) {
    for_each_kind_of_cell(
        [&]<std::size_t width>() { of_[width].resize(cells_of<width>(mesh).size(), block); });
  }

  /// The blocks of the mesh's cells of so many nodes, for those who drop some of them.
  template <std::size_t width>
  std::vector<std::int32_t>& of() {
    return of_[width];
  }

  /// Gives the mesh those of its blocks that have cells, where there are several. All cells were taken.
  void put_into(SolidMesh& mesh) const {
    std::vector<std::int32_t> number(names_.size(), -1);
    for (const auto& blocks : of_) {
      for (const std::int32_t block : blocks) number[block] = 0;
    }
    for (std::size_t block = 0; block < names_.size(); ++block) {
      if (number[block] < 0) continue;
      number[block] = static_cast<std::int32_t>(mesh.block_names.size());
      mesh.block_names.push_back(names_[block]);
    }
    if (mesh.block_names.size() < 2) return mesh.block_names.clear();
    for (const auto& blocks : of_) {
      for (const std::int32_t block : blocks) mesh.cell_to_block.push_back(number[block]);
    }
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::int32_t> numbers_;
  std::array<std::vector<std::int32_t>, 9> of_;  ///< of cells of so many nodes
};

}  // namespace quadloop
