#pragma once

#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"

namespace quadloop {

/// The ids from `begin` to before `end`, ascending; from 0.
template <class Tag, class Rep>
constexpr auto ids_between(Id<Tag, Rep> begin, Id<Tag, Rep> end) {
  return std::views::iota(begin.value(), end.value()) |
         std::views::transform([](Rep number) { return Id<Tag, Rep>{number}; });
}
template <class Tag, class Rep>
constexpr auto ids_below(Id<Tag, Rep> end) {
  return ids_between(Id<Tag, Rep>{0}, end);
}

/// A value for each entity of one kind: a vector whose subscripts are ids of that kind alone. Those below
/// size() have values; no other is looked for. Its values in the order of the ids are a contiguous range, so
/// that it passes as a std::span.
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
  /// Of all values, ascending.
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
