#include "app/heap.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

namespace quadloop {

namespace {

/// Huge pages for all whole pages of an array: each is asked for in one go instead of five hundred.
void advise_huge_pages([[maybe_unused]] void* array, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = 4096;
  const auto begin = reinterpret_cast<std::uintptr_t>(array), first = (begin + page - 1) / page * page,
             end = (begin + bytes) / page * page;
  madvise(static_cast<char*>(array) + (first - begin), end - first, MADV_HUGEPAGE);  // refused: as before
#endif
}

}  // namespace

void set_up_heap() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(large_array));
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, static_cast<int>(spare_end));
#endif
}

}  // namespace quadloop

#ifndef __SANITIZE_ADDRESS__  // which has its own, to see what is released in the wrong way
void* operator new(std::size_t bytes) {
  void* array = std::malloc(bytes);
  if (array == nullptr) throw std::bad_alloc();
  if (bytes >= quadloop::large_array) quadloop::advise_huge_pages(array, bytes);
  return array;
}
void operator delete(void* array) noexcept { std::free(array); }
void operator delete(void* array, std::size_t /*bytes*/) noexcept { std::free(array); }
#endif
