#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

/// An item by its rank and its number there.
struct Partner {
  int rank = -1;  ///< negative: none
  std::int64_t item = 0;
  bool found() const { return rank >= 0; }
};

/// Keys of an item and of its partner, which has them swapped.
template <std::size_t width>
struct PairKey {
  std::array<std::uint64_t, width> own, partner;
};

namespace detail {

template <std::size_t width>
int meeting_rank(const PairKey<width>& key, int ranks) {
  std::uint64_t state = 0;
  for (const std::uint64_t word : std::min(key.own, key.partner))
    state = mixed_bits(state ^ word) + golden_step;
  return static_cast<int>(state % static_cast<std::uint64_t>(ranks));
}

template <std::size_t width>
struct PairCard {
  std::array<std::uint64_t, width> own;
  Partner place;
  friend bool operator<(const PairCard& a, const PairCard& b) { return a.own < b.own; }
};

}  // namespace detail

/// Returns for each key of this rank the item, on any rank, whose own key is the partner's key; this may be
/// the item itself. Own keys must be distinct. Independent of the number of ranks. *Collective.*
template <std::size_t width>
std::vector<Partner> find_partners(const Communicator& comm, std::span<const PairKey<width>> keys) {
  std::vector<int> ranks;
  ranks.reserve(keys.size());
  for (const auto& key : keys) ranks.push_back(detail::meeting_rank(key, comm.size()));
  const Exchange exchange(comm, ranks);
  const auto arrived = exchange.deliver(keys);
  std::vector<std::int64_t> numbers(keys.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::int64_t>(i);
  numbers = exchange.deliver(numbers);
  std::vector<detail::PairCard<width>> cards;
  cards.reserve(arrived.size());
  for (const Exchange::Source& source : exchange.sources()) {
    for (std::size_t i = source.begin; i < source.end; ++i)
      cards.push_back({arrived[i].own, {source.rank, numbers[i]}});
  }
  std::sort(cards.begin(), cards.end());
  std::vector<Partner> answers(arrived.size());
  for (std::size_t i = 0; i < arrived.size(); ++i) {
    const auto card =
        std::lower_bound(cards.begin(), cards.end(), detail::PairCard<width>{arrived[i].partner, {}});
    if (card != cards.end() && card->own == arrived[i].partner) answers[i] = card->place;
  }
  return exchange.answer(answers);
}

}  // namespace quadloop
