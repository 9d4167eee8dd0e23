#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop {

/// Finds nodes by the tags that a file gives them; tags may have gaps and come in any order.
class NodeTags {
 public:
  void reserve(std::size_t nodes) { entries_.reserve(nodes); }
  /// Tags are added in the order of the nodes.
  void add(std::int64_t tag) { entries_.push_back({tag, size32(entries_)}); }

  /// After the last add(). A tag that was given to two nodes; 0 where there is none.
  std::int64_t sort();

  /// After sort(). An id that is not valid where no node has the tag.
  NodeId node_of(std::int64_t tag) const;

 private:
  struct Entry {
    std::int64_t tag = 0;
    std::int32_t node = -1;
  };
  std::vector<Entry> entries_;
};

}  // namespace quadloop
