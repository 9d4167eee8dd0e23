#include "io/parts/part_files.hpp"

#include <mpi.h>

#include <algorithm>
#include <span>

#include "io/cgns/cgns_file.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/native/native_file.hpp"
#include "io/parts/part_cgns.hpp"
#include "io/parts/part_links.hpp"
#include "io/parts/part_pvtu.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::io {

namespace {

LoadedMesh loaded_part(const MeshPart& part, const std::vector<std::string>& blocks) {
  LoadedMesh loaded;
  loaded.mesh = part.mesh;
  loaded.blocks = size32(blocks);
  loaded.triangle_to_block = part.mesh.blocks.of_triangles;
  loaded.quad_to_block = part.mesh.blocks.of_quads;
  loaded.triangle_to_block.resize(part.mesh.triangles.size(), 0);
  loaded.quad_to_block.resize(part.mesh.quads.size(), 0);
  loaded.block_names = blocks;
  loaded.solution = part.field;
  return loaded;
}

/// Returns the inner lines of the whole mesh on the root rank. *Collective.*
std::vector<PartIndex::Line> lines_at_root(const Communicator& comm, const Mesh& mesh) {
  const BoundaryStream stream(comm, mesh, EdgeChoice::inner_lines);
  std::vector<PartIndex::Line> lines;
  std::vector<std::vector<BoundaryStream::Edge>> edges = stream.gather(comm);
  for (std::size_t n = 0; comm.is_root() && n < edges.size(); ++n)
    lines.push_back({stream.present()[n]->name, std::move(edges[n])});
  return lines;
}

}  // namespace

std::vector<std::string> part_formats(const std::vector<std::string>& formats, std::size_t blocks) {
  std::vector<std::string> with_place;
  for (const char* const format : {"mesh", "cgns", "vtu"}) {
    if (std::ranges::find(formats, format) != formats.end() && (blocks < 2 || format != std::string("cgns")))
      with_place.emplace_back(format);
  }
  return with_place;
}

std::vector<std::string> part_file_names(const std::string& prefix, std::int32_t parts,
                                         const std::vector<std::string>& formats) {
  std::vector<std::string> names{prefix + part_index_suffix};
  if (std::ranges::find(formats, "vtu") != formats.end()) names.push_back(prefix + ".pvtu");
  for (std::int32_t part = 0; part < parts; ++part) {
    names.push_back(part_path(prefix, part, "links"));
    for (const std::string& format : formats) names.push_back(part_path(prefix, part, format));
  }
  return names;
}

void PartFiles::write(const std::string& prefix, const PartIndex& index, const std::vector<MeshPart>& parts) {
  comm_.together([&] {
    for (const MeshPart& part : parts) write_part(prefix, index, part);
    if (!comm_.is_root()) return;
    write_part_index(outputs_, index, prefix + part_index_suffix);
    const bool has_values = !parts.empty() && parts[0].field;
    if (std::ranges::find(index.formats, "vtu") != index.formats.end())
      write_part_pvtu(outputs_, index, has_values ? *parts[0].field : Field{}, prefix);
  });
}

void PartFiles::write_part(const std::string& prefix, const PartIndex& index, const MeshPart& part) {
  const LoadedMesh loaded = loaded_part(part, index.blocks);
  const MeshStream stream(outputs_.communicator(), loaded, EdgeChoice::all);
  for (const std::string& format : index.formats) {
    const std::string path = part_path(prefix, part.number, format);
    if (format == "mesh") write_native(outputs_, stream, path);
    if (format == "vtu") write_vtu(outputs_, stream, path);
    if (format == "cgns") {
      write_cgns(outputs_, stream, path);
      put_part_into_cgns(outputs_.staged_last(), part, index.parts);
    }
  }
  write_part_links(outputs_, part, index.parts, part_path(prefix, part.number, "links"));
}

void PartFiles::commit(OutputSet& whole) { OutputSet::commit_together(comm_, {&whole, &outputs_}); }

void PartFiles::commit() { OutputSet::commit_together(comm_, {&outputs_}); }

PartIndex part_index(const Communicator& comm, const Mesh& mesh, std::int32_t parts,
                     const std::vector<std::string>& formats) {
  PartIndex index{.parts = parts,
                  .formats = formats,
                  .nodes = comm.sum(mesh.owned_nodes),
                  .triangles = comm.sum(std::ssize(mesh.triangles)),
                  .quads = comm.sum(std::ssize(mesh.quads)),
                  .blocks = mesh.blocks.names,
                  .boundaries = {},
                  .edges = {},
                  .lines = lines_at_root(comm, mesh),
                  .pairs = mesh.pairs,
                  .strips = mesh.strips,
                  .warnings = {}};
  if (index.blocks.empty()) index.blocks.push_back(usual_block_name(1, 0));
  std::vector<std::int64_t> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (boundary.inner_line) continue;
    index.boundaries.push_back({boundary.name, boundary.condition, {}, boundary.layers});
    own.push_back(std::ssize(boundary.edges));
  }
  const std::vector<std::int64_t> all = gather_at_root(comm, own);
  index.edges.assign(index.boundaries.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) index.edges[i % index.edges.size()] += all[i];
  return index;
}

}  // namespace quadloop::io
