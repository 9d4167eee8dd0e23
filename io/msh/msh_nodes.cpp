#include "io/msh/msh_nodes.hpp"

#include <algorithm>

namespace quadloop::io {

std::int64_t NodeTags::sort() {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.tag < b.tag; });
  const auto twice = std::adjacent_find(entries_.begin(), entries_.end(),
                                        [](const Entry& a, const Entry& b) { return a.tag == b.tag; });
  return twice == entries_.end() ? 0 : twice->tag;
}

NodeId NodeTags::node_of(std::int64_t tag) const {
  if (entries_.empty() || tag < entries_.front().tag || tag > entries_.back().tag) return {};
  const std::size_t guess = tag - entries_.front().tag;  // correct if the tags have no gaps
  if (guess < entries_.size() && entries_[guess].tag == tag) return NodeId{entries_[guess].node};
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), tag,
                                      [](const Entry& entry, std::int64_t t) { return entry.tag < t; });
  return found->tag == tag ? NodeId{found->node} : NodeId{};
}

}  // namespace quadloop::io
