#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// What the names of such files end in.
inline constexpr const char* tree_suffix = ".tree.h5";

/// Writes the tree as HDF5 into the set: the attributes of TreeAttributes on the root group, and the leaves
/// along the curve as the datasets tree (n x 2), x, y, level, wanted, mark, triangles, quads,
/// adapted. The bytes depend on the record alone: not on the number of ranks, not on the time. *Collective.*
/// Throws OutputError on all ranks.
void write_tree(OutputSet& outputs, const TreeRecord& tree, const std::string& path);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_tree(const Communicator& comm, const TreeRecord& tree, const std::string& path);

/// Reads a tree file; rank r gets the r-th of comm.size() equal shares of the leaves, along the curve.
/// *Collective*: every rank opens the file. Throws InputError on all ranks where it is no tree file of ours,
/// or one that was cut short.
TreeRecord read_tree(const Communicator& comm, const std::string& path);

}  // namespace quadloop
