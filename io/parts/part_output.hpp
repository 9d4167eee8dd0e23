#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/parts/part_files.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::io {

/// Request to write partitions of a mesh.
struct PartRequest {
  std::string prefix;
  std::int32_t parts = 0;
  std::vector<std::string> formats;  ///< from part_formats()
};

/// Partitions a distributed mesh and writes its parts under temporary names; `files` must be committed
/// afterwards. Throws InputError or OutputError on all ranks. *Collective.*
PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh, const Field* field,
                           const PartRequest& request);

/// The same for an existing partition.
PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh,
                           const CellParts& cells, const Field* field, const PartRequest& request);

/// The same for a mesh that is whole on the root rank; prefix, number and formats are used on every rank.
/// *Collective.*
PartStatistics write_parts(PartFiles& files, const Communicator& comm, const LoadedMesh& loaded,
                           const PartRequest& request);

}  // namespace quadloop::io
