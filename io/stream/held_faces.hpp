#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// The faces of a mesh stored on one rank, for face-based formats: inner faces ordered by owner and
/// neighbour, where the owner has the lower number (OpenFOAM's upper-triangular order); then those of each
/// patch in its order. Cells are numbered as in for_each_cell().
class HeldFaces {
 public:
  /// A face between two cells; `local` is its number in the owner.
  struct Inner {
    std::int32_t owner, neighbour;
    std::int32_t local;
  };

  /// The mesh must outlive the object. Throws OutputError, with `path`, unless each face is between two cells
  /// or on one patch.
  HeldFaces(const FileMesh& mesh, const std::string& path);

  const std::vector<Inner>& internal() const { return internal_; }
  /// Returns the cell of each face of a patch.
  const std::vector<std::int32_t>& cells_at(std::size_t patch) const { return of_patch_[patch]; }

  /// Counter-clockwise as seen from outside the owner. For a face of a patch, from outside its cell: the
  /// order of nodes in the patch is ignored.
  FileBoundary::Face nodes(const Inner& face) const { return nodes(face.owner, face.local); }
  FileBoundary::Face patch_nodes(std::size_t patch, std::size_t number) const {
    return nodes(of_patch_[patch][number], local_of_patch_[patch][number]);
  }

 private:
  FileBoundary::Face nodes(std::int32_t cell, std::int32_t local) const;
  [[noreturn]] void refuse() const;

  const FileMesh& mesh_;
  std::string path_;
  std::vector<Inner> internal_;
  std::vector<std::vector<std::int32_t>> of_patch_, local_of_patch_;
};

}  // namespace quadloop::io
