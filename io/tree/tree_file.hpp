#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::io {

/// Suffix of tree files.
inline constexpr const char* tree_suffix = ".tree.h5";

/// Writes the tree as HDF5 into the set: TreeAttributes as attributes of the root group, and the leaves along
/// the curve as the datasets tree (n x 2), x, y, level, wanted, mark, triangles, quads, adapted. The bytes
/// depend only on the record, not on the number of ranks or the time. Throws OutputError on all ranks.
/// *Collective.*
void write_tree(OutputSet& outputs, const TreeRecord& tree, const std::string& path);

/// The same as a separate output, in place when the function returns. *Collective.*
void write_tree(const Communicator& comm, const TreeRecord& tree, const std::string& path);

/// Reads a tree file; rank r gets the r-th of comm.size() equal parts of the leaves, along the curve. Every
/// rank opens the file. Throws InputError on all ranks if it is not a tree file of this program, or is
/// truncated. *Collective.*
TreeRecord read_tree(const Communicator& comm, const std::string& path);

}  // namespace quadloop::io
