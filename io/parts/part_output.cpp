#include "io/parts/part_output.hpp"

#include "mesher/partition/partition.hpp"

namespace quadloop::io {

PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh, const Field* field,
                           const PartRequest& request) {
  return write_parts(files, comm, mesh, partition(comm, mesh, request.parts), field, request);
}

PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh,
                           const CellParts& cells, const Field* field, const PartRequest& request) {
  const std::vector<MeshPart> parts = make_parts(comm, mesh, cells, field);
  files.write(request.prefix, part_index(comm, mesh, request.parts, request.formats), parts);
  return part_statistics(comm, parts);
}

PartStatistics write_parts(PartFiles& files, const Communicator& comm, const LoadedMesh& loaded,
                           const PartRequest& request) {
  LoadedMesh listed = loaded;
  list_inner_curves(listed);
  listed.mesh.blocks = {listed.block_names, listed.triangle_to_block, listed.quad_to_block};
  return write_parts(files, comm, listed.mesh, listed.solution ? &*listed.solution : nullptr, request);
}

}  // namespace quadloop::io
