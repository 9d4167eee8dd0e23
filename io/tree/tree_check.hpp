#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::io {

/// Throws InputError if the attributes are impossible for this number of leaves; `path` begins the message.
/// Not collective.
void require_possible_attributes(const TreeAttributes& attributes, std::int64_t leaves,
                                 const std::string& path);

/// Throws InputError if a number is not finite, or a friction or thickness is negative. Not collective.
void require_possible_flow(const MeasuredFlow& flow, const std::string& path);

/// Returns the wakes with these points and numbers of points. Throws InputError if the numbers do not fit, or
/// for points that no path can have.
std::vector<std::vector<Point>> possible_wakes(const std::vector<Point>& points,
                                               const std::vector<std::int64_t>& sizes,
                                               const std::string& path);

/// Throws InputError if the runs are impossible or have other numbers of cells than the attributes. Not
/// collective.
void require_possible_runs(const std::vector<BlockRun>& runs, const TreeAttributes& attributes,
                           const std::string& path);

/// Throws InputError on all ranks unless the leaves are those of complete trees along the space-filling
/// curve, each with valid data, and the number of their cells agrees with the attributes. `before` is the
/// leaf before this rank's first. *Collective.*
void require_whole_tree(const Communicator& comm, const TreeRecord& tree,
                        const std::optional<LeafRecord>& before, const std::string& path);

}  // namespace quadloop::io
