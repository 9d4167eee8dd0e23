#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace quadloop {

/// An immutable array of trivially copyable values with shared ownership: copies refer to the same memory,
/// which is released with the last of them.
template <class T>
class SharedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;

  SharedArray() = default;
  SharedArray(std::vector<T> values) : size_{values.size()} {
    if (values.empty()) return;
    const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    values_ = {owner, owner->data()};
  }
  /// Takes `size` values at `values.get()`.
  SharedArray(std::shared_ptr<const T> values, std::size_t size) : values_{std::move(values)}, size_{size} {}

  /// Sanitized builds check the index.
  const T& operator[](std::size_t i) const { return std::span(data(), size_)[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* data() const { return values_.get(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

  /// The same memory as values of another type, whose alignment it must have.
  template <class U>
  SharedArray<U> as() const {
    return {{values_, reinterpret_cast<const U*>(data())}, size_ * sizeof(T) / sizeof(U)};
  }

 private:
  std::shared_ptr<const T> values_;
  std::size_t size_ = 0;
};

}  // namespace quadloop
