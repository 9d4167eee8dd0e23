#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <ranges>
#include <span>
#include <type_traits>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// A communication pattern between ranks, set up once, for repeated transfer of rows of values in both
/// directions. Each rank has items, each with one destination rank, possibly itself. They arrive in the order
/// of the source ranks, and those of one source rank in its order.
///
///     const Exchange questions(comm, rank_of_question);
///     const auto asked = questions.deliver(points);
///     ... one answer for each entry of `asked` ...
///     answers = questions.answer(answers);  // in the order of `points`
class Exchange {
 public:
  /// The items that arrive from one rank: the range [begin, end).
  struct Source {
    int rank;
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  /// Item i of this rank goes to rank `ranks[i]`. `comm` must outlive the object. *Collective.*
  Exchange(const Communicator& comm, std::span<const int> ranks);

  std::size_t items() const { return targets_.empty() ? 0 : targets_.back().end; }
  std::size_t arrivals() const { return sources_.empty() ? 0 : sources_.back().end; }
  /// The ranks from which something arrives, ascending.
  std::span<const Source> sources() const { return sources_; }
  /// Number of items that arrive from ranks lower than `rank`.
  std::size_t arrivals_before(int rank) const;

  /// Sends `width` values per item; returns those of each arrival. *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> deliver(const Rows& rows, std::size_t width = 1) const;

  /// Reverse direction: sends `width` values per arrival; returns those of each item. *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> answer(const Rows& rows, std::size_t width = 1) const;

 private:
  using Bytes = std::span<const std::byte>;
  using Room = std::span<std::byte>;
  void move(std::span<const Source> to, Bytes rows, std::span<const Source> from, Room room,
            std::size_t row) const;
  void deliver_bytes(Bytes rows, Room room, std::size_t row) const;
  void answer_bytes(Bytes rows, Room room, std::size_t row) const;

  const Communicator* comm_;
  std::vector<Source> targets_, sources_;
  std::vector<std::uint32_t> order_;  ///< items sorted by rank; empty if already sorted
};

/// Values collected one by one, each with a destination rank.
template <class T>
class Outbox {
 public:
  void add(int rank, const T& value) {
    ranks_.push_back(rank);
    values_.push_back(value);
  }
  /// Returns the values for this rank, in the order of the source ranks. *Collective.*
  std::vector<T> deliver(const Communicator& comm) const { return Exchange(comm, ranks_).deliver(values_); }

 private:
  std::vector<int> ranks_;
  std::vector<T> values_;
};

/// Gathers the values of all ranks on the root, in the order of ranks; empty elsewhere. *Collective.*
template <std::ranges::contiguous_range Values>
auto gather_at_root(const Communicator& comm, const Values& values) {
  return Exchange(comm, std::vector<int>(values.size(), 0)).deliver(values);
}

/// Distributes the root's values: `counts[r]` of them to each rank r, in the order of ranks. Both arguments
/// are used on the root only. *Collective.*
template <std::ranges::contiguous_range Values>
auto scatter_from_root(const Communicator& comm, const Values& values, std::span<const std::int64_t> counts) {
  std::vector<int> ranks;
  for (int rank = 0; comm.is_root() && rank < comm.size(); ++rank)
    ranks.insert(ranks.end(), counts[rank], rank);
  return Exchange(comm, ranks).deliver(std::span(values).first(ranks.size()));
}

/// The numbers 0, 1, 2 ..., divided into one contiguous range per rank, in the order of ranks.
class RankRanges {
 public:
  /// `begin` is the first number of this rank's range. *Collective.*
  RankRanges(const Communicator& comm, std::int64_t begin) : begins_{comm.all_gather(begin)} {}

  /// Returns the rank that has the number.
  int rank_of(std::int64_t number) const {
    return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), number) - begins_.begin()) - 1;
  }
  std::int64_t begin(int rank) const { return begins_[rank]; }

 private:
  std::vector<std::int64_t> begins_;
};

/// Ghost entries of a rank's array, which are copies of entries on their owner ranks and are updated from
/// them.
class GhostExchange {
 public:
  struct Copy {
    std::int32_t entry = 0;  ///< index on this rank
    int owner = 0;
    std::int32_t owners_entry = 0;  ///< index on the owner, relative to `first_owned` there
  };
  /// *Collective.*
  GhostExchange(const Communicator& comm, std::vector<Copy> ghosts, std::int32_t first_owned = 0);

  /// Replaces the rows of ghosts, of `width` values each, by those of their owners. *Collective.*
  template <std::ranges::contiguous_range Rows>
  void update_rows(Rows& rows, std::size_t width) const;
  template <std::ranges::contiguous_range Values>
  void update(Values& values) const {
    update_rows(values, 1);
  }
  /// Updates only the ghosts of owned entries for which `changed` is true. *Collective.*
  template <std::ranges::contiguous_range Values, class Changed>
  void update(Values& values, const Changed& changed) const;
  /// For values that are not stored in an array: calls `take(entry, value)` for each ghost, where `value` is
  /// the result of `value_of(entry)` on its owner. *Collective.*
  template <class ValueOf, class Take>
  void update_some(const ValueOf& value_of, const Take& take) const;

 private:
  static std::vector<int> owners_of(std::vector<Copy>& ghosts);  ///< sorts the copies by owner

  Exchange exchange_;                         ///< from ghosts to owners
  std::vector<std::int32_t> ghosts_, owned_;  ///< entries of items and of arrivals
};

template <std::ranges::contiguous_range Rows>
std::vector<std::ranges::range_value_t<Rows>> Exchange::deliver(const Rows& rows, std::size_t width) const {
  using T = std::ranges::range_value_t<Rows>;
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> arrived(arrivals() * width);
  deliver_bytes(std::as_bytes(std::span(rows)), std::as_writable_bytes(std::span(arrived)),
                width * sizeof(T));
  return arrived;
}

template <std::ranges::contiguous_range Rows>
std::vector<std::ranges::range_value_t<Rows>> Exchange::answer(const Rows& rows, std::size_t width) const {
  using T = std::ranges::range_value_t<Rows>;
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> answers(items() * width);
  answer_bytes(std::as_bytes(std::span(rows)), std::as_writable_bytes(std::span(answers)), width * sizeof(T));
  return answers;
}

template <std::ranges::contiguous_range Rows>
void GhostExchange::update_rows(Rows& rows, std::size_t width) const {
  const auto row_of = [&](std::size_t entry) { return std::ranges::begin(rows) + entry * width; };
  std::vector<std::ranges::range_value_t<Rows>> out;
  out.reserve(owned_.size() * width);
  for (const std::int32_t entry : owned_) std::copy_n(row_of(entry), width, std::back_inserter(out));
  out = exchange_.answer(out, width);
  auto row = out.cbegin();
  for (const std::int32_t entry : ghosts_) {
    std::copy_n(row, width, row_of(entry));
    row += width;
  }
}

template <std::ranges::contiguous_range Values, class Changed>
void GhostExchange::update(Values& values, const Changed& changed) const {
  struct Item {
    std::ranges::range_value_t<Values> value;
    bool is_new;
  };
  const auto at = std::ranges::begin(values);
  std::vector<Item> items;  // all entries: their number is known, and few are at interfaces
  items.reserve(owned_.size());
  for (const std::int32_t entry : owned_) items.push_back({at[entry], changed(entry)});
  items = exchange_.answer(items);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].is_new) at[ghosts_[i]] = items[i].value;
  }
}

template <class ValueOf, class Take>
void GhostExchange::update_some(const ValueOf& value_of, const Take& take) const {
  std::vector<std::decay_t<std::invoke_result_t<ValueOf, std::int32_t>>> values;
  values.reserve(owned_.size());
  for (const std::int32_t entry : owned_) values.push_back(value_of(entry));
  values = exchange_.answer(values);
  for (std::size_t i = 0; i < values.size(); ++i) take(ghosts_[i], values[i]);
}

}  // namespace quadloop
