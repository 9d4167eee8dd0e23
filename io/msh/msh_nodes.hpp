#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop::io {

/// Finds nodes by their tags in a file; tags may have gaps and be in any order.
class NodeTags {
 public:
  void reserve(std::size_t nodes) { entries_.reserve(nodes); }
  /// Tags are added in the order of the nodes.
  void add(std::int64_t tag) { entries_.push_back({tag, size32(entries_)}); }

  /// Call after the last add(). Returns a duplicate tag; 0 if there is none.
  std::int64_t sort();

  /// Call after sort(). Returns an invalid id if no node has the tag.
  NodeId node_of(std::int64_t tag) const;

 private:
  struct Entry {
    std::int64_t tag = 0;
    std::int32_t node = -1;
  };
  std::vector<Entry> entries_;
};

}  // namespace quadloop::io
