#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/base/communicator.hpp"

namespace quadloop {

/// Communicator::exchange for messages of any size: those above `largest` bytes go in several rounds.
/// *Collective.*
template <class T>
std::vector<std::vector<T>> exchange_pieces(const Communicator& comm, std::vector<std::vector<T>> to_rank,
                                            std::size_t largest = std::size_t{1} << 28) {
  if (comm.size() == 1) return to_rank;
  const std::size_t step = std::max<std::size_t>(1, largest / sizeof(T));
  std::size_t longest = 0;
  for (const auto& values : to_rank) longest = std::max(longest, values.size());
  longest = static_cast<std::size_t>(comm.maximum(static_cast<std::int64_t>(longest)));
  if (longest <= step) return comm.exchange(to_rank);
  std::vector<std::vector<T>> received(to_rank.size()), piece(to_rank.size());
  for (std::size_t begin = 0; begin < longest; begin += step) {
    for (std::size_t rank = 0; rank < piece.size(); ++rank) {
      const std::vector<T>& all = to_rank[rank];
      const auto at = [&](std::size_t i) {
        return all.begin() + static_cast<std::ptrdiff_t>(std::min(i, all.size()));
      };
      piece[rank].assign(at(begin), at(begin + step));
    }
    const auto arrived = comm.exchange(piece);
    for (std::size_t rank = 0; rank < piece.size(); ++rank)
      received[rank].insert(received[rank].end(), arrived[rank].begin(), arrived[rank].end());
  }
  return received;
}

}  // namespace quadloop
