#pragma once

#include <cstring>

namespace quadloop {

namespace detail {

template <class T>
std::vector<T> from_bytes(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

}  // namespace detail

template <class T>
std::vector<T> Communicator::all_gather(const T& value) const {
  return all_gather_values(std::span<const T>(&value, 1));
}

template <class T>
std::vector<T> Communicator::all_gather_values(std::span<const T> values) const {
  return detail::from_bytes<T>(all_gather_bytes(std::as_bytes(values)));
}

template <class T>
void Communicator::broadcast(std::vector<T>& values, int from) const {
  static_assert(std::is_trivially_copyable_v<T>);
  values.resize(broadcast_size(values.size(), from));
  broadcast_bytes(std::as_writable_bytes(std::span(values)), from);
}

}  // namespace quadloop
