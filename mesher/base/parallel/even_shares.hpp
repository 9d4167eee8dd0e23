#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Returns the first of a rank's even share of `rows`, which are divided in the order of ranks.
inline std::int64_t even_begin(std::int64_t rows, int rank, int ranks) {
  const std::int64_t whole = rows / ranks, rest = rows % ranks;
  return whole * rank + rest * rank / ranks;
}

/// A rank's even share of rows.
struct EvenShare {
  std::int64_t begin = 0, end = 0;
  EvenShare(const Communicator& comm, std::int64_t rows)
      : begin{even_begin(rows, comm.rank(), comm.size())},
        end{even_begin(rows, comm.rank() + 1, comm.size())} {}
  std::int64_t size() const { return end - begin; }
};

/// Calls `visit(list, first, rows)` for each list with rows in this rank's share of the rows of all lists,
/// one after another: `rows` of the list, from `first`.
template <class Visit>
void for_share_of_lists(const Communicator& comm, std::span<const std::int64_t> counts, const Visit& visit) {
  const EvenShare share(comm, std::accumulate(counts.begin(), counts.end(), std::int64_t{0}));
  std::int64_t before = 0;
  for (std::size_t list = 0; list < counts.size(); before += counts[list++]) {
    const std::int64_t begin = std::max(before, share.begin),
                       end = std::min(before + counts[list], share.end);
    if (begin < end) visit(list, begin - before, end - begin);
  }
}

/// Moves values, which are in the order of ranks, such that this rank has `count` of them, in the same order.
/// Over all ranks, as many are wanted as there are. *Collective.*
template <class T>
std::vector<T> in_ranges(const Communicator& comm, std::vector<T> own, std::int64_t count) {
  if (comm.size() == 1) return own;
  const auto begins_of = [&](std::int64_t size) {
    std::vector<std::int64_t> begins{0};
    for (const std::int64_t of_rank : comm.all_gather(size)) begins.push_back(begins.back() + of_rank);
    return begins;
  };
  const std::vector<std::int64_t> old = begins_of(std::ssize(own)), wanted = begins_of(count);
  const std::int64_t first = old[comm.rank()], first_wanted = wanted[comm.rank()];
  /// Calls `visit(rank, begin, end)` for the parts of [begin, end) in the ranges of ranks.
  const auto for_parts = [&](std::int64_t begin, std::int64_t end, const std::vector<std::int64_t>& ranges,
                             const auto& visit) {
    for (int rank = 0; rank < comm.size(); ++rank) {
      const std::int64_t low = std::max(begin, ranges[rank]), high = std::min(end, ranges[rank + 1]);
      if (low < high) visit(rank, low, high);
    }
  };
  std::vector<T> share(count);
  std::vector<Communicator::Outgoing> out;
  for_parts(first, old[comm.rank() + 1], wanted, [&](int rank, std::int64_t low, std::int64_t high) {
    out.push_back({rank, std::as_bytes(std::span<const T>(own).subspan(low - first, high - low))});
  });
  std::vector<Communicator::Incoming> in;
  for_parts(first_wanted, first_wanted + count, old, [&](int rank, std::int64_t low, std::int64_t high) {
    in.push_back({rank, std::as_writable_bytes(std::span<T>(share).subspan(low - first_wanted, high - low))});
  });
  comm.exchange_messages(out, in);
  return share;
}

/// The same such that each rank has an even share of the rows, of `width` values each. *Collective.*
template <class T>
std::vector<T> in_even_shares(const Communicator& comm, std::vector<T> own, std::int64_t width = 1) {
  if (comm.size() == 1 || width == 0) return own;
  const EvenShare share(comm, comm.sum(std::ssize(own)) / width);
  return in_ranges(comm, std::move(own), share.size() * width);
}

}  // namespace quadloop
