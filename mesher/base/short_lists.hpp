#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace quadloop {

/// Memory for lists that live no longer than it does: on the stack while they are short, so that they need no
/// allocations. Lists that outgrow it are moved to the heap. What a list gives back is not used again.
template <std::size_t bytes>
class ShortLists {
 public:
  std::pmr::memory_resource* memory() { return &memory_; }

 private:
  std::array<std::byte, bytes> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), bytes};
};

}  // namespace quadloop
