#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace quadloop::io {

/// Sends values through a pipe, whose end it owns. If there is no reader, data are discarded.
class PipeWriter {
 public:
  static constexpr bool reads = false;

  explicit PipeWriter(int descriptor) : descriptor_{descriptor} {}
  ~PipeWriter();
  PipeWriter(const PipeWriter&) = delete;
  PipeWriter& operator=(const PipeWriter&) = delete;

  void bytes(const void* from, std::size_t size);
  void flush();

 private:
  void write_out(const char* from, std::size_t size);

  int descriptor_;
  std::vector<char> waiting_;
};

/// Thrown if the pipe ends before the values do.
struct PipeEnded {};

/// Receives values.
class PipeReader {
 public:
  static constexpr bool reads = true;
  // number of values; limits the memory that a wrong size can allocate
  static constexpr std::size_t largest_step = std::size_t{1} << 22;

  explicit PipeReader(int descriptor);
  ~PipeReader();
  PipeReader(const PipeReader&) = delete;
  PipeReader& operator=(const PipeReader&) = delete;

  void bytes(void* to, std::size_t size);

 private:
  int descriptor_;
  std::vector<char> room_;
  std::size_t begin_ = 0, end_ = 0;  ///< of the unread bytes in it
};

/// Takes down how a type is sent, from a value of it that holds nothing.
class PipeSignature {
 public:
  static constexpr bool reads = false;

  void bytes(const void*, std::size_t size) { number = (number ^ size) * 0x100000001b3; }

  std::uint64_t number = 0xcbf29ce484222325;  ///< FNV-1a
};

namespace detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

}  // namespace detail

template <class Pipe, class T>
void pass(Pipe& pipe, T& value);

/// Passes the elements of a string or vector. Memory is allocated as they arrive, not by the announced size.
template <class Pipe, class List>
void pass_list(Pipe& pipe, List& list) {
  using Element = typename List::value_type;
  std::uint64_t size = list.size();
  pass(pipe, size);
  if constexpr (std::is_same_v<Pipe, PipeSignature>) {
    Element one{};
    pass(pipe, one);
  } else if constexpr (std::is_trivially_copyable_v<Element>) {
    for (std::size_t done = 0; done < size;) {
      const std::size_t step = std::min<std::size_t>(size - done, PipeReader::largest_step);
      if constexpr (Pipe::reads) list.resize(done + step);
      pipe.bytes(list.data() + done, step * sizeof(Element));
      done += step;
    }
  } else {
    for (std::size_t i = 0; i < size; ++i) {
      if constexpr (Pipe::reads) list.emplace_back();
      pass(pipe, list[i]);
    }
  }
}

/// Writes a value to a PipeWriter, or reads it, initially empty, from a PipeReader. For a type with several
/// fields overload `pass_fields`.
template <class Pipe, class T>
void pass(Pipe& pipe, T& value) {
  if constexpr (detail::IsOptional<T>::value) {
    bool there = value.has_value();
    pass(pipe, there);
    if constexpr (Pipe::reads) {
      if (there) value.emplace();
    }
    if constexpr (std::is_same_v<Pipe, PipeSignature>) {
      typename T::value_type one{};
      pass(pipe, one);
    } else if (there) {
      pass(pipe, *value);
    }
  } else if constexpr (std::is_same_v<T, std::string> || detail::IsVector<T>::value) {
    pass_list(pipe, value);
  } else if constexpr (std::is_trivially_copyable_v<T>) {
    pipe.bytes(&value, sizeof(T));
  } else {
    pass_fields(pipe, value);
  }
}

/// Passes several values one after another.
template <class Pipe, class First, class Second, class... More>
void pass(Pipe& pipe, First& first, Second& second, More&... more) {
  pass(pipe, first);
  pass(pipe, second);
  (pass(pipe, more), ...);
}

/// Returns a number that differs for types that are sent in different ways, also between two builds.
template <class T>
std::uint64_t signature_of() {
  PipeSignature signature;
  T value{};
  pass(signature, value);
  return signature.number;
}

}  // namespace quadloop::io
