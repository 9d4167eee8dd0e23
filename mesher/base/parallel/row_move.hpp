#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"

namespace quadloop {

/// Rows of values that move from one distribution over the ranks to another, and back. In the old one each
/// rank has a contiguous range of the rows' numbers; each row has one place in the new one.
class RowMove {
 public:
  /// `first` is the number of this rank's first row, `wanted` are the numbers of the rows that it gets.
  /// `comm` must outlive the object. *Collective.*
  RowMove(const Communicator& comm, std::int64_t first, std::span<const std::int64_t> wanted)
      : exchange_{comm, owners(comm, first, wanted)} {
    asked_.reserve(exchange_.arrivals());
    for (const std::int64_t number : exchange_.deliver(wanted))
      asked_.push_back(static_cast<std::int32_t>(number - first));
  }

  /// The number of new rows on this rank.
  std::size_t size() const { return exchange_.items(); }
  /// For each row that leaves this rank its index among the rank's old rows.
  std::span<const std::int32_t> leaving() const { return asked_; }

  /// Takes `width` values for each old row; returns those of the new rows. *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> forth(const Rows& rows, std::size_t width = 1) const {
    std::vector<std::ranges::range_value_t<Rows>> out;
    if (width == 0) return out;
    out.reserve(asked_.size() * width);
    for (const std::int32_t row : asked_) {
      const auto begin = std::ranges::begin(rows) + static_cast<std::ptrdiff_t>(row * width);
      out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
    }
    return exchange_.answer(out, width);
  }
  /// Takes values of each row that leaves, in the order of leaving(); returns those of the new rows.
  /// *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> forth_from(const Rows& leaving_rows) const {
    return exchange_.answer(leaving_rows);
  }

  /// Inverse of forth(): takes values of the new rows; returns those of the old ones, all of which must have
  /// been wanted. *Collective.*
  template <std::ranges::contiguous_range Rows>
  std::vector<std::ranges::range_value_t<Rows>> back(const Rows& rows, std::size_t width = 1) const {
    if (width == 0) return std::vector<std::ranges::range_value_t<Rows>>();
    const auto arrived = exchange_.deliver(rows, width);
    std::vector<std::ranges::range_value_t<Rows>> old(arrived.size());
    for (std::size_t i = 0; i < asked_.size(); ++i)
      std::copy_n(arrived.begin() + i * width, width, old.begin() + asked_[i] * width);
    return old;
  }

 private:
  static std::vector<int> owners(const Communicator& comm, std::int64_t first,
                                 std::span<const std::int64_t> wanted) {
    const RankRanges ranges(comm, first);
    std::vector<int> ranks;
    ranks.reserve(wanted.size());
    for (const std::int64_t number : wanted) ranks.push_back(ranges.rank_of(number));
    return ranks;
  }

  Exchange exchange_;
  std::vector<std::int32_t> asked_;
};

}  // namespace quadloop
