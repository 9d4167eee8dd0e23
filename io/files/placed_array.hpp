#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"

namespace quadloop::io {

/// A list of numbers that is one piece of a file.
struct PlacedArray {
  enum class Number : std::uint8_t { real_32, real_64, integer_8, integer_32, integer_64 };
  static constexpr std::int64_t unknown = -1;

  std::int64_t count = unknown;  ///< of the numbers
  std::int64_t place = unknown;  ///< offset in the file
  Number number = Number::real_64;
  bool big_endian = false;

  bool is_of_integers() const { return number >= Number::integer_8; }
};

namespace detail {

/// Reads `count` numbers of an array from its number `first`, from 0, and passes them as `Wanted` to
/// `take(values)` piece by piece.
template <class Number, class Wanted, class Take>
void read_pieces(const PlacedInput& file, const PlacedArray& array, std::int64_t first, std::int64_t count,
                 const Take& take) {
  constexpr std::int64_t numbers_of_piece = std::int64_t{1} << 16;
  std::vector<Number> numbers;
  std::vector<Wanted> values;
  for (std::int64_t done = 0; done < count; done += std::ssize(numbers)) {
    numbers.resize(std::min(numbers_of_piece, count - done));
    file.read_at(array.place + (first + done) * std::int64_t{sizeof(Number)},
                 std::as_writable_bytes(std::span(numbers)));
    values.clear();
    for (const Number number : numbers)
      values.push_back(static_cast<Wanted>(array.big_endian ? in_order<std::endian::big>(number)
                                                            : in_order<std::endian::little>(number)));
    take(std::span<const Wanted>(values));
  }
}

}  // namespace detail

/// Reads `count` numbers of an array from its number `first`, from 0, and passes them as `Wanted`, double or
/// std::int64_t, to `take(values)` piece by piece. Throws InputError if the file cannot be read.
template <class Wanted, class Take>
void read_numbers(const PlacedInput& file, const PlacedArray& array, std::int64_t first, std::int64_t count,
                  const Take& take) {
  using enum PlacedArray::Number;
  const auto read = [&]<class Number>() {
    detail::read_pieces<Number, Wanted>(file, array, first, count, take);
  };
  switch (array.number) {
    case real_32: return read.template operator()<float>();
    case real_64: return read.template operator()<double>();
    case integer_8: return read.template operator()<std::uint8_t>();
    case integer_32: return read.template operator()<std::int32_t>();
    case integer_64: return read.template operator()<std::int64_t>();
  }
}

}  // namespace quadloop::io
