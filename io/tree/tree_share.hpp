#pragma once

// For quadloop-reader (io/reader), a separate process.
#include <cstdint>
#include <optional>
#include <string>

#include "io/files/reading/value_pipe.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::io {

/// The part of a tree file read by one rank.
struct TreeShare {
  TreeRecord tree;
  std::optional<LeafRecord> before;  ///< last leaf of the previous rank
};

template <class Pipe>
void pass_fields(Pipe& pipe, TreeShare& share) {
  pass(pipe, share.tree.attributes, share.tree.leaves, share.tree.measured.walls, share.tree.measured.wakes,
       share.tree.measured.thickness, share.tree.block_runs, share.before);
}

/// Reads the part of a rank as read_tree() does, in this process, which HDF5 may crash if the file is
/// damaged. Throws InputError.
TreeShare read_tree_share(const std::string& path, std::int64_t rank, std::int64_t ranks);

}  // namespace quadloop::io
