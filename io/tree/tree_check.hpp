#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Throws InputError where no mesh can have such attributes with so many leaves; `path` begins the message.
/// Local.
void require_possible_attributes(const TreeAttributes& attributes, std::int64_t leaves,
                                 const std::string& path);

/// Throws InputError where a number is not finite or friction is below 0. Local.
void require_possible_wall(const MeasuredWall& wall, const std::string& path);

/// Throws InputError on all ranks unless the leaves are those of whole trees along the space-filling curve,
/// each with what it may hold, and their cells as many as the attributes say. `before` is the leaf before
/// this rank's first. *Collective.*
void require_whole_tree(const Communicator& comm, const TreeRecord& tree,
                        const std::optional<LeafRecord>& before, const std::string& path);

}  // namespace quadloop
