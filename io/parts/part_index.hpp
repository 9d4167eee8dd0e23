#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Contents of PREFIX.parts: a set of partitions and the whole mesh.
struct PartIndex {
  /// An inner line, with the node numbers of the whole mesh.
  struct Line {
    std::string name;
    std::vector<std::array<std::int64_t, 2>> edges;
  };

  std::int32_t parts = 0;
  std::vector<std::string> formats;  ///< of the parts, by suffix
  std::int64_t nodes = 0, triangles = 0, quads = 0;
  std::vector<std::string> blocks;        ///< names
  std::vector<BoundaryEdges> boundaries;  ///< without edges and inner lines
  std::vector<std::int64_t> edges;        ///< number of edges of each boundary
  std::vector<Line> lines;
  std::vector<PeriodicPair> pairs;
  std::vector<StripLayers> strips;    ///< with the node numbers of the whole mesh
  std::vector<std::string> warnings;  ///< of the reader
};

/// The suffix of an index, and whether a path has it.
inline constexpr const char* part_index_suffix = ".parts";
bool is_part_index(const std::string& path);

/// Returns the file of one part (from 0) in a set written to `prefix`; `suffix` is that of a format, or
/// "links".
std::string part_path(const std::string& prefix, std::int32_t part, const std::string& suffix);

/// On the set's only rank. Throws OutputError.
void write_part_index(OutputSet& outputs, const PartIndex& index, const std::string& path);

/// On the calling rank only. Throws InputError.
PartIndex read_part_index(const std::string& path);

}  // namespace quadloop::io
