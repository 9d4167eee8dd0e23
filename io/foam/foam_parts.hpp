#pragma once

// Inside io/foam only: what both writers of a polyMesh share.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

/// The files of a polyMesh: the five that each has, and of several blocks the zones of cells.
std::vector<std::string> foam_files(const StreamBlocks& blocks);

/// The header of one of them.
std::string foam_head(const std::string& type, const std::string& object, const std::string& note = {});

/// What owner and neighbour say of the mesh in their headers.
std::string foam_counts_note(const StreamCounts& counts, std::int64_t faces, std::int64_t internal_faces);

/// The type of a patch for Boundary::condition.
std::string foam_patch_type(const std::string& condition);

/// The file `boundary`: patches of these types, whose faces follow the internal ones. *Collective.*
void write_foam_boundary(const Communicator& comm, const StagedFile& staged,
                         const std::vector<StreamedPatch>& patches, const std::vector<std::string>& types,
                         std::int64_t internal_faces);

/// The file `points`. *Collective.*
void write_foam_points(const MeshStream& stream, const StagedFile& staged);

/// The file `cellZones`: a zone for each block. *Collective.*
void write_foam_zones(const MeshStream& stream, const StreamBlocks& blocks, const StagedFile& staged);

/// A face takes room for one number more than it has nodes.
template <class Node, std::size_t width>
void put_foam_face(TextRows& text, const std::array<Node, width>& nodes) {
  text.put(width, '(');
  for (std::size_t i = 0; i < width; ++i) text.put(nodes[i], i + 1 < width ? ' ' : ')');
  text.mark('\n');
}

/// The writer of a mesh that the only rank holds.
void write_foam_held(OutputSet& outputs, const MeshStream& stream, const std::string& path);

}  // namespace quadloop
