#include "io/parts/part_output.hpp"

#include <optional>
#include <span>

#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop::io {

PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh, const PartData& data,
                           const PartRequest& request) {
  return write_parts(files, comm, mesh, partition(comm, mesh, request.parts), data, request);
}

PartStatistics write_parts(PartFiles& files, const Communicator& comm, const Mesh& mesh,
                           const CellParts& cells, const PartData& data, const PartRequest& request) {
  const std::vector<MeshPart> parts = make_parts(comm, mesh, cells, data);
  files.write(request.prefix, part_index(comm, mesh, request.parts, request.formats, request.blocks), parts);
  return part_statistics(comm, parts);
}

PartStatistics write_parts_of_root(PartFiles& files, const Communicator& comm, const LoadedMesh& whole,
                                   PartRequest request) {
  const MeshOrder order = own_order(whole.mesh);
  const Mesh mesh = scatter_mesh(comm, whole.mesh, order);
  std::optional<Field> field;
  if (comm.any(whole.solution.has_value()))
    field = scatter_field(comm, whole.solution.value_or(Field{}), mesh, order);
  const std::span<const std::int32_t> triangles(whole.triangle_to_block), quads(whole.quad_to_block);
  const std::vector<std::int32_t> triangle_to_block = scatter_ordered(comm, triangles, order.triangles),
                                  quad_to_block = scatter_ordered(comm, quads, order.quads);
  request.blocks = broadcast_words(comm, whole.block_names);
  return write_parts(files, comm, mesh,
                     {.field = field ? &*field : nullptr,
                      .triangle_to_block = triangle_to_block,
                      .quad_to_block = quad_to_block},
                     request);
}

}  // namespace quadloop::io
