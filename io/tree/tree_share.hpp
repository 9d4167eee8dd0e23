#pragma once

// For quadloop-reader (io/reader), in a process of its own.
#include <cstdint>
#include <optional>
#include <string>

#include "io/files/reading/value_pipe.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// What one rank takes from a tree file.
struct TreeShare {
  TreeRecord tree;
  std::optional<LeafRecord> before;  ///< the last leaf of the rank before
};

template <class Pipe>
void pass_fields(Pipe& pipe, TreeShare& share) {
  pass(pipe, share.tree.attributes, share.tree.leaves, share.tree.measured_wall, share.before);
}

/// Reads the share of a rank as read_tree() says, in this process, which HDF5 may end where the file is
/// damaged. Throws InputError.
TreeShare read_tree_share(const std::string& path, std::int64_t rank, std::int64_t ranks);

}  // namespace quadloop
