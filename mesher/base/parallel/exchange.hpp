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

/// Ways between ranks, found once, on which rows of values then go point to point as often as wanted, there
/// and back. Each rank has items, each of them for one rank, itself allowed; they arrive by the rank that
/// they come from, and in its order.
///
///     const Exchange questions(comm, rank_of_question);
///     const auto asked = questions.deliver(points);
///     ... one answer for each entry of `asked` ...
///     answers = questions.answer(answers);  // in the order of `points`
class Exchange {
 public:
  /// The items that arrive from one rank: [begin, end) of all.
  struct Source {
    int rank;
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  /// Item i of this rank is for rank `ranks[i]`. `comm` must outlive the exchange. *Collective.*
  Exchange(const Communicator& comm, std::span<const int> ranks);

  std::size_t items() const { return targets_.empty() ? 0 : targets_.back().end; }
  std::size_t arrivals() const { return sources_.empty() ? 0 : sources_.back().end; }
  /// Those ranks alone from which something arrives, ascending.
  std::span<const Source> sources() const { return sources_; }
  /// How many items arrive from lower ranks than `rank`.
  std::size_t arrivals_before(int rank) const;

  /// From `width` values for each item those of each arrival. *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> deliver(const Rows& rows, std::size_t width = 1) const;

  /// The way back: from `width` values for each arrival those of each item. *Collective.*
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
  std::vector<std::size_t> order_;  ///< the items by their ranks; empty where they stand so
};

/// Values that are put together one by one, each for a rank.
template <class T>
class Outbox {
 public:
  void add(int rank, const T& value) {
    ranks_.push_back(rank);
    values_.push_back(value);
  }
  /// Those for this rank, by the rank that they come from, then in its order. *Collective.*
  std::vector<T> deliver(const Communicator& comm) const { return Exchange(comm, ranks_).deliver(values_); }

 private:
  std::vector<int> ranks_;
  std::vector<T> values_;
};

/// All ranks' values on the root, one rank's after the other's; elsewhere none. *Collective.*
template <std::ranges::contiguous_range Values>
auto gather_at_root(const Communicator& comm, const Values& values) {
  return Exchange(comm, std::vector<int>(values.size(), 0)).deliver(values);
}

/// The root's values in pieces: `counts[r]` of them for each rank r, in the order of ranks. Both count on the
/// root alone. *Collective.*
template <std::ranges::contiguous_range Values>
auto scatter_from_root(const Communicator& comm, const Values& values, std::span<const std::int64_t> counts) {
  std::vector<int> ranks;
  for (int rank = 0; comm.is_root() && rank < comm.size(); ++rank)
    ranks.insert(ranks.end(), counts[rank], rank);
  return Exchange(comm, ranks).deliver(std::span(values).first(ranks.size()));
}

/// A row of numbers, from 0, of which each rank has one range, in the order of ranks.
class RankRanges {
 public:
  /// `begin` is the first number of this rank's range. *Collective.*
  RankRanges(const Communicator& comm, std::int64_t begin) : begins_{comm.all_gather(begin)} {}

  /// The rank that has the number.
  int rank_of(std::int64_t number) const {
    return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end(), number) - begins_.begin()) - 1;
  }
  std::int64_t begin(int rank) const { return begins_[rank]; }

 private:
  std::vector<std::int64_t> begins_;
};

/// Entries of a rank's row that stand for entries of other ranks' rows, their owners', and are brought up to
/// date from them.
class CopyExchange {
 public:
  struct Copy {
    std::int32_t entry = 0;  ///< on this rank
    int owner = 0;
    std::int32_t owners_entry = 0;  ///< counted from `first_owned` there
  };
  /// *Collective.*
  CopyExchange(const Communicator& comm, std::vector<Copy> copies, std::int32_t first_owned = 0);

  /// Rows of `width` values: those of copies are replaced by their owners'. *Collective.*
  template <std::ranges::contiguous_range Rows>
  void update_rows(Rows& rows, std::size_t width) const;
  template <std::ranges::contiguous_range Values>
  void update(Values& values) const {
    update_rows(values, 1);
  }
  /// The same for the owned entries for which `changed` holds, alone. *Collective.*
  template <std::ranges::contiguous_range Values, class Changed>
  void update(Values& values, const Changed& changed) const;
  /// The same where few entries have a value: `take(entry, value)` is called for each copy with what
  /// `value_of(entry)` is on its owner. *Collective.*
  template <class ValueOf, class Take>
  void update_some(const ValueOf& value_of, const Take& take) const;

 private:
  static std::vector<int> owners_of(std::vector<Copy>& copies);  ///< of copies that it sorts by them

  Exchange exchange_;                         ///< from copies to owners
  std::vector<std::int32_t> copies_, owned_;  ///< the entries of items and of arrivals
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
void CopyExchange::update_rows(Rows& rows, std::size_t width) const {
  const auto row_of = [&](std::size_t entry) { return std::ranges::begin(rows) + entry * width; };
  std::vector<std::ranges::range_value_t<Rows>> out;
  out.reserve(owned_.size() * width);
  for (const std::int32_t entry : owned_) std::copy_n(row_of(entry), width, std::back_inserter(out));
  out = exchange_.answer(out, width);
  auto row = out.cbegin();
  for (const std::int32_t entry : copies_) {
    std::copy_n(row, width, row_of(entry));
    row += width;
  }
}

template <std::ranges::contiguous_range Values, class Changed>
void CopyExchange::update(Values& values, const Changed& changed) const {
  struct Item {
    std::ranges::range_value_t<Values> value;
    bool is_new;
  };
  const auto at = std::ranges::begin(values);
  std::vector<Item> items;  // all of them: their number is known, and few are at the border
  items.reserve(owned_.size());
  for (const std::int32_t entry : owned_) items.push_back({at[entry], changed(entry)});
  items = exchange_.answer(items);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].is_new) at[copies_[i]] = items[i].value;
  }
}

template <class ValueOf, class Take>
void CopyExchange::update_some(const ValueOf& value_of, const Take& take) const {
  std::vector<std::decay_t<std::invoke_result_t<ValueOf, std::int32_t>>> values;
  values.reserve(owned_.size());
  for (const std::int32_t entry : owned_) values.push_back(value_of(entry));
  values = exchange_.answer(values);
  for (std::size_t i = 0; i < values.size(); ++i) take(copies_[i], values[i]);
}

}  // namespace quadloop
