#include "io/parts/part_output.hpp"

#include <optional>

#include "mesher/mesh/scatter_blocks.hpp"
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

PartStatistics write_parts_of_root(PartFiles& files, const Communicator& comm, const LoadedMesh& whole,
                                   const PartRequest& request) {
  LoadedMesh with_lines;
  if (!whole.inner_curves.empty()) {
    with_lines = whole;
    list_inner_curves(with_lines);
  }
  const Mesh& listed = whole.inner_curves.empty() ? whole.mesh : with_lines.mesh;
  const MeshOrder order = own_order(listed);
  Mesh mesh = scatter_mesh(comm, listed, order);
  std::optional<Field> field;
  if (comm.any(whole.solution.has_value()))
    field = scatter_field(comm, whole.solution.value_or(Field{}), mesh, order);
  mesh.blocks =
      scatter_blocks(comm, {whole.block_names, whole.triangle_to_block, whole.quad_to_block}, order);
  return write_parts(files, comm, mesh, field ? &*field : nullptr, request);
}

}  // namespace quadloop::io
