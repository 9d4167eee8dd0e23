#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/parts/part_files.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop {

/// A mesh in parts, beside the whole.
struct PartRequest {
  std::string prefix;
  std::int32_t parts = 0;
  std::vector<std::string> formats;              ///< as part_formats() gives them
  std::vector<std::string> blocks = {"domain"};  ///< names
};

/// Divides a distributed mesh and writes its parts under temporary names; `files` is yet to be committed.
/// *Collective.* Throws InputError or OutputError on all ranks.
PartFigures write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh, const PartData& data,
                        const PartRequest& request);

/// The same for one that is divided already.
PartFigures write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh, const CellParts& cells,
                        const PartData& data, const PartRequest& request);

/// The same for a mesh that the root rank holds whole; prefix, number and formats count on every rank.
/// *Collective.*
PartFigures write_parts_of_root(PartFiles& files, const Communicator& comm, const LoadedMesh& whole,
                                PartRequest request);

}  // namespace quadloop
