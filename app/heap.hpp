#pragma once

#include <cstddef>

namespace quadloop {

/// Arrays of so many bytes and more are in huge pages, where the system has such, and go back to it as soon
/// as they are released, but for those that the heap's spare end had room for.
inline constexpr std::size_t large_array = std::size_t{16} << 20;
/// Bytes by which the heap grows beyond what is asked for.
inline constexpr std::size_t spare_end = std::size_t{64} << 20;

/// How the program keeps its memory (glibc). Arrays of megabytes come and go between the stages: kept, their
/// pages need not be asked for and cleared again each time (a tenth of the run for a million cells). The
/// large ones are not kept: between the small ones that outlive them they would leave holes that no other
/// fits into, by luck of the order (a third more at most). To be called before the first array is made.
void set_up_heap();

}  // namespace quadloop
