#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// One block of a mesh as a mesh of its own, for formats in which each block has its own nodes. Nodes, cells
/// and boundary faces are in the order of the whole mesh. A boundary between two blocks is in both, with the
/// block on its left. Strips are omitted.
class BlockMesh {
 public:
  const std::string& name() const { return name_; }
  const MeshStream& stream() const { return *stream_; }
  /// Returns the number in the block, from 0 over all ranks, of the node in a row of the whole stream; -1 if
  /// the block does not contain it.
  NodeNumber node_of_row(std::int64_t row) const {
    const std::int64_t in_plane = numbers_[row / levels_];
    return in_plane < 0 ? in_plane : in_plane * levels_ + row % levels_;
  }

 private:
  friend class PlaneBlockCutter;
  friend class HeldBlockCutter;

  std::string name_;
  Mesh plane_;  ///< of a plane or extruded mesh; with the next two
  std::optional<Field> solution_;
  std::optional<ExtrudedMesh> extruded_;
  FileMesh held_;  ///< of a stored mesh
  std::vector<std::int64_t> numbers_;
  std::int64_t levels_ = 1;
  std::optional<MeshStream> stream_;
};

/// Returns the blocks of a mesh with several; the stream must outlive them. In a 3D mesh that is stored the
/// faces between blocks A and B become the boundary "A__B"; those of other meshes must be boundaries already
/// (name_interfaces()). `path` is for messages. *Collective.*
std::vector<std::unique_ptr<BlockMesh>> block_meshes(const MeshStream& stream, const std::string& path);

/// Returns one block of a mesh, without its strips; a boundary between two blocks has the block on its left.
LoadedMesh one_block(const LoadedMesh& whole, std::int32_t block);

/// Adds the edges between blocks A and B that belong to no boundary to the boundary "A__B", so that each
/// block has all its boundaries.
void name_interfaces(LoadedMesh& whole);

}  // namespace quadloop::io
