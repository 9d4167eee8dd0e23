#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop {

/// Consecutive ids of one kind, as a range for loops and algorithms.
template <class Id>
class IdRange {
 public:
  class iterator {
   public:
    using value_type = Id;
    using difference_type = std::ptrdiff_t;

    constexpr iterator() = default;
    constexpr explicit iterator(Id id) : number_{id.value()} {}

    constexpr Id operator*() const { return Id{number_}; }
    constexpr iterator& operator++() {
      ++number_;
      return *this;
    }
    constexpr iterator operator++(int) {
      const iterator before = *this;
      ++number_;
      return before;
    }
    friend constexpr bool operator==(iterator, iterator) = default;

   private:
    typename Id::rep number_ = 0;
  };

  constexpr IdRange(Id begin, Id end) : begin_{begin}, end_{end} {}

  constexpr iterator begin() const { return iterator{begin_}; }
  constexpr iterator end() const { return iterator{end_}; }
  constexpr bool empty() const { return begin_ == end_; }
  constexpr std::size_t size() const { return static_cast<std::size_t>(end_.value() - begin_.value()); }

 private:
  Id begin_, end_;
};

/// Returns the ids from `begin` (or 0) up to but excluding `end`, which must not be less than `begin`.
template <class Tag, class Rep>
constexpr IdRange<Id<Tag, Rep>> ids_between(Id<Tag, Rep> begin, Id<Tag, Rep> end) {
  return {begin, end};
}
template <class Tag, class Rep>
constexpr IdRange<Id<Tag, Rep>> ids_below(Id<Tag, Rep> end) {
  return {Id<Tag, Rep>{0}, end};
}

/// Values of all entities of one kind: a vector that is indexed by ids of that kind. Ids must be below
/// size(). The values are contiguous in the order of the ids, so the vector converts to std::span.
template <class Id, class T>
class IdVector {
  static_assert(!std::is_same_v<T, bool>, "bits of a std::vector<bool> are no range of values: take char");

 public:
  IdVector() = default;
  explicit IdVector(std::size_t size, const T& value = T{}) : values_(size, value) {}
  explicit IdVector(std::vector<T> values) : values_{std::move(values)} {}  ///< in the order of the ids

  T& operator[](Id id) { return values_[id.value()]; }
  const T& operator[](Id id) const { return values_[id.value()]; }

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  /// All ids, ascending.
  auto ids() const { return ids_below(Id{size32(values_)}); }

  void resize(std::size_t size, const T& value = T{}) { values_.resize(size, value); }
  void reserve(std::size_t size) { values_.reserve(size); }
  /// Returns the new value's id.
  Id push_back(T value) {
    const Id id{size32(values_)};
    values_.push_back(std::move(value));
    return id;
  }

  friend bool operator==(const IdVector&, const IdVector&) = default;

 private:
  std::vector<T> values_;
};

}  // namespace quadloop
