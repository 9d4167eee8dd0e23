#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// The faces of a mesh that one rank holds, for formats of faces: those inside by owner and neighbour, the
/// owner of the lower number (OpenFOAM's upper-triangular order); then those of each patch as the patch has
/// them. Cells are numbered as for_each_cell() does.
class HeldFaces {
 public:
  /// A face between two cells; `local` is which of its owner's faces it is.
  struct Inner {
    std::int32_t owner, neighbour;
    std::int32_t local;
  };

  /// The mesh must outlive it. Throws OutputError, with `path`, unless each face is between two cells or on
  /// one patch.
  HeldFaces(const FileMesh& mesh, const std::string& path);

  const std::vector<Inner>& internal() const { return internal_; }
  /// The cell of each face of a patch.
  const std::vector<std::int32_t>& cells_at(std::size_t patch) const { return of_patch_[patch]; }

  /// Counter-clockwise as seen from outside the owner; of a face of a patch, whose own order of nodes says
  /// nothing, from outside its cell.
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

}  // namespace quadloop
