#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace quadloop {

/// Memory for short-lived lists, which must not outlive it: on the stack while they are short, which avoids
/// allocations, else on the heap. Memory released by a list is not reused.
template <std::size_t bytes>
class ShortLists {
 public:
  std::pmr::memory_resource* memory() { return &memory_; }

 private:
  std::array<std::byte, bytes> room_;
  std::pmr::monotonic_buffer_resource memory_{room_.data(), bytes};
};

}  // namespace quadloop
