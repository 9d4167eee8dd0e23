#include "io/parts/part_reader.hpp"

#include <mpi.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/native/native_file.hpp"
#include "io/parts/part_index.hpp"
#include "io/parts/part_links.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/partition/join_parts.hpp"

namespace quadloop::io {

namespace {

LoadedMesh read_piece(const std::string& path, const std::string& format) {
  if (format == "mesh") return read_native(Communicator(MPI_COMM_SELF), path);
  if (format == "cgns") return plane_of(read_cgns(Communicator(MPI_COMM_SELF), path), path);
  return plane_of(read_vtu(path), path);
}

class PartReader {
 public:
  explicit PartReader(const std::string& path)
      : path_{path}, prefix_{path.substr(0, path.rfind('.'))}, index_{read_part_index(path)} {
    for (const char* const format : {"mesh", "cgns", "vtu"}) {
      if (format_.empty() && std::ranges::find(index_.formats, format) != index_.formats.end())
        format_ = format;
    }
    if (format_.empty())
      throw InputError(path + ": its parts are not in a format that can be read: mesh, cgns or vtu");
  }

  LoadedMesh read() {
    std::vector<MeshPart> parts;
    for (std::int32_t number = 0; number < index_.parts; ++number) {
      const std::string links = part_path(prefix_, number, "links");
      parts.push_back(read_part_links(links, number, index_.parts));
      if (parts.back().edges.size() != index_.boundaries.size())
        throw InputError(links + ": it has other boundaries than " + path_);
    }
    PartJoiner joiner(counts(parts), index_.boundaries, index_.blocks);
    for (MeshPart& part : parts) {
      const std::string path = part_path(prefix_, part.number, format_);
      fill(part, path);
      joiner.put(part, path);
      part = {};
    }
    JoinedMesh joined = joiner.finish(path_);
    LoadedMesh whole;
    whole.mesh = std::move(joined.mesh);
    whole.blocks = size32(index_.blocks);
    whole.triangle_to_block = whole.mesh.blocks.of_triangles;
    whole.quad_to_block = whole.mesh.blocks.of_quads;
    if (whole.blocks == 1) whole.mesh.blocks = {};
    whole.inner_curves = inner_lines();
    whole.block_names = index_.blocks;
    whole.solution = std::move(joined.field);
    whole.mesh.strips = index_.strips;
    whole.mesh.pairs = index_.pairs;
    whole.warnings = index_.warnings;
    std::ranges::move(warnings_, std::back_inserter(whole.warnings));
    std::erase_if(whole.mesh.boundaries, [](const BoundaryEdges& b) { return b.edges.empty(); });
    return whole;
  }

 private:
  /// Returns the size of the whole mesh, limited by what the parts contain: the numbers of the index are not
  /// trusted for memory allocation.
  WholeCounts counts(const std::vector<MeshPart>& parts) const {
    std::int64_t nodes = 0, triangles = 0, quads = 0;
    std::vector<std::int64_t> edges(index_.edges.size(), 0);
    for (const MeshPart& part : parts) {
      nodes += std::ranges::count(part.owners, part.number);
      triangles += std::ssize(part.triangles);
      quads += std::ssize(part.quads);
      for (std::size_t b = 0; b < edges.size(); ++b) edges[b] += std::ssize(part.edges[b]);
    }
    if (nodes != index_.nodes || triangles != index_.triangles || quads != index_.quads ||
        edges != index_.edges)
      throw InputError(
          path_ +
          ": the nodes, cells and boundary edges of its parts do not add up to those of the whole; "
          "write the set again");
    const auto count = [](std::int64_t number) { return static_cast<std::int32_t>(number); };
    WholeCounts counts{count(nodes), count(triangles), count(quads), {}};
    for (const std::int64_t number : edges) counts.edges.push_back(count(number));
    return counts;
  }

  std::vector<BoundaryEdges> inner_lines() const {
    std::vector<BoundaryEdges> lines;
    const auto node = [](std::int64_t number) { return NodeId{static_cast<std::int32_t>(number)}; };
    for (const PartIndex::Line& line : index_.lines) {
      BoundaryEdges& edges = lines.emplace_back(BoundaryEdges{line.name, {}, {}});
      for (const auto& [from, to] : line.edges) edges.edges.push_back({node(from), node(to)});
    }
    return lines;
  }

  /// Reads the part's mesh and values from its own file.
  void fill(MeshPart& part, const std::string& path) {
    LoadedMesh loaded = read_piece(path, format_);
    number_blocks(loaded, path);
    std::vector<BoundaryEdges> own = std::move(loaded.mesh.boundaries);
    part.mesh = std::move(loaded.mesh);
    part.mesh.boundaries = index_.boundaries;
    std::map<std::string, BoundaryEdges*> by_name;
    for (BoundaryEdges& boundary : own) by_name.emplace(boundary.name, &boundary);
    for (BoundaryEdges& boundary : part.mesh.boundaries) {
      const auto found = by_name.find(boundary.name);
      if (found != by_name.end()) boundary.edges = std::move(found->second->edges);
    }
    part.mesh.blocks = {index_.blocks, std::move(loaded.triangle_to_block), std::move(loaded.quad_to_block)};
    part.field = std::move(loaded.solution);
    std::ranges::move(loaded.warnings, std::back_inserter(warnings_));
  }

  /// Numbers blocks as in the whole mesh. In `.vtu` a part has only the blocks of its own cells, by name.
  void number_blocks(LoadedMesh& loaded, const std::string& path) const {
    if (loaded.blocks == std::ssize(index_.blocks)) return;
    std::vector<std::int32_t> numbers;
    for (const std::string& name : loaded.block_names) {
      const auto found = std::ranges::find(index_.blocks, name);
      if (found == index_.blocks.end())
        throw InputError(path + ": it has " + std::to_string(loaded.blocks) + " blocks, the whole mesh " +
                         std::to_string(index_.blocks.size()) + ", none of which is '" + name + "'");
      numbers.push_back(static_cast<std::int32_t>(found - index_.blocks.begin()));
    }
    for (auto* const cell_to_block : {&loaded.triangle_to_block, &loaded.quad_to_block}) {
      for (std::int32_t& block : *cell_to_block) block = numbers[block];
    }
  }

  std::string path_, prefix_, format_;
  PartIndex index_;
  std::vector<std::string> warnings_;
};

}  // namespace

LoadedMesh read_parts(const std::string& path) { return PartReader(path).read(); }

}  // namespace quadloop::io
