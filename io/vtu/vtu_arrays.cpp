#include "io/vtu/vtu_arrays.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <span>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// Plain or base64-encoded bytes. A base64 stream may end with padding and be followed by another one, as
/// after a header.
class ByteStream {
 public:
  ByteStream(std::string_view text, bool base64) : text_{text}, base64_{base64} {}

  /// An upper bound.
  std::size_t bytes_left() const {
    return pending_.size() - taken_ + (base64_ ? text_.size() / 4 * 3 + 3 : text_.size());
  }

  /// Returns whether there were enough bytes.
  bool read(std::span<char> out) {
    if (!base64_) {
      if (text_.size() < out.size()) return false;
      std::copy_n(text_.begin(), out.size(), out.begin());
      text_.remove_prefix(out.size());
      return true;
    }
    for (char& byte : out) {
      if (taken_ == pending_.size() && !decode_group()) return false;
      byte = pending_[taken_++];
    }
    return true;
  }

 private:
  static int digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
  }

  bool decode_group() {
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    while (digits + padding < 4 && !text_.empty()) {
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
      const int value = c == '=' ? 0 : digit(c);
      if (value < 0 || (padding > 0 && c != '=')) return false;
      bits = bits << 6 | value;
      (c == '=' ? padding : digits) += 1;
    }
    if (digits + padding < 4 || digits < 2) return false;
    pending_.clear();
    taken_ = 0;
    for (int k = 0; k < digits - 1; ++k) pending_.push_back(static_cast<char>(bits >> (16 - 8 * k) & 0xffU));
    return true;
  }

  std::string_view text_;
  bool base64_;
  std::string pending_;
  std::size_t taken_ = 0;
};

template <class T>
T value_at(const char* bytes, bool big_endian) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Calls `use` with a value of the C++ type for a VTK type; returns false for a non-numeric type.
template <class Use>
bool with_type(const std::string& type, const Use& use) {
  if (type == "Float64") return use(double{}), true;
  if (type == "Float32") return use(float{}), true;
  if (type == "Int8") return use(std::int8_t{}), true;
  if (type == "UInt8" || type == "String") return use(std::uint8_t{}), true;
  if (type == "Int16") return use(std::int16_t{}), true;
  if (type == "UInt16") return use(std::uint16_t{}), true;
  if (type == "Int32") return use(std::int32_t{}), true;
  if (type == "UInt32") return use(std::uint32_t{}), true;
  if (type == "Int64") return use(std::int64_t{}), true;
  if (type == "UInt64") return use(std::uint64_t{}), true;
  return false;
}

std::optional<std::uint64_t> read_size(ByteStream& stream, const VtuDocument& document) {
  std::array<char, 8> bytes;
  const std::size_t width = document.wide_header ? 8 : 4;
  if (!stream.read(std::span(bytes).first(width))) return {};
  if (document.wide_header) return value_at<std::uint64_t>(bytes.data(), document.big_endian);
  return value_at<std::uint32_t>(bytes.data(), document.big_endian);
}

/// Empty if the blocks do not match their header.
std::optional<std::vector<char>> inflate_blocks(ByteStream& stream, const VtuDocument& document) {
  constexpr std::uint64_t largest_ratio = 1100;  // zlib's maximum is 1032
  const auto blocks = read_size(stream, document), size = read_size(stream, document),
             rest = read_size(stream, document);
  if (!blocks || !size || !rest || *blocks > stream.bytes_left()) return {};
  std::vector<std::uint64_t> packed_sizes;
  for (std::uint64_t i = 0; i < *blocks; ++i) {
    const auto packed = read_size(stream, document);
    if (!packed) return {};
    packed_sizes.push_back(*packed);
  }
  std::vector<char> bytes, packed;
  for (std::size_t i = 0; i < packed_sizes.size(); ++i) {
    const std::uint64_t wanted = i + 1 == packed_sizes.size() && *rest > 0 ? *rest : *size;
    if (packed_sizes[i] > stream.bytes_left() || wanted > largest_ratio * (packed_sizes[i] + 1)) return {};
    packed.resize(packed_sizes[i]);
    if (!stream.read(packed)) return {};
    const std::size_t before = bytes.size();
    bytes.resize(before + wanted);
    uLongf written = wanted;
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (status != Z_OK || written != wanted) return {};
  }
  return bytes;
}

bool parse(std::string_view token, double& value) { return parse_real(token, value); }
bool parse(std::string_view token, std::int64_t& value) {
  const auto [stopped, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  return error == std::errc{} && stopped == token.data() + token.size();
}

}  // namespace

void VtuNumbers::refuse(const VtuArray& array, const std::string& message) const {
  scan_.refuse_at(array.place, "the array '" + array.name + "' of " + array.section + " " + message);
}

std::vector<char> VtuNumbers::bytes(const VtuArray& array, std::optional<std::size_t> count) const {
  const bool appended = array.format == "appended";
  if (!appended && array.format != "binary")
    refuse(array, "has the format '" + array.format + "'; save it as ascii, binary or appended");
  std::string_view text = scan_.text().substr(array.begin, array.end - array.begin);
  if (appended) {
    const std::size_t size = document_.appended_end - document_.appended_begin;
    if (!array.offset || static_cast<std::size_t>(*array.offset) > size)
      refuse(array, "stands beyond the end of the file; it is cut short");
    text = scan_.text().substr(document_.appended_begin, size).substr(*array.offset);
  }
  ByteStream stream(text, !appended || !document_.appended_raw);
  std::optional<std::vector<char>> bytes;
  if (document_.compressed) {
    bytes = inflate_blocks(stream, document_);
  } else if (const auto size = read_size(stream, document_); size && *size <= stream.bytes_left()) {
    bytes.emplace(*size);
    if (!stream.read(*bytes)) bytes.reset();
  }
  if (!bytes && count == 0U) bytes.emplace();
  if (!bytes) refuse(array, "is cut short, or not what its header says");
  if (count && bytes->size() != *count) {
    refuse(array, "holds " + std::to_string(bytes->size()) + " bytes, not " + std::to_string(*count));
  }
  return std::move(*bytes);
}

template <class Number>
std::vector<Number> VtuNumbers::converted(const VtuArray& array, const std::vector<char>& bytes) const {
  std::vector<Number> result;
  with_type(array.type, [&]<class T>(T) {
    result.reserve(bytes.size() / sizeof(T));
    for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T)) {
      result.push_back(static_cast<Number>(value_at<T>(bytes.data() + at, document_.big_endian)));
    }
  });
  return result;
}

template <class Number>
std::vector<Number> VtuNumbers::ascii_numbers(const VtuArray& array,
                                              std::optional<std::int64_t> count) const {
  constexpr std::string_view blanks = " \t\r\n";
  const std::string_view data = scan_.text().substr(array.begin, array.end - array.begin);
  std::vector<Number> result;
  if (count) result.reserve(std::min<std::size_t>(*count, data.size() / 2 + 1));
  for (std::size_t at = data.find_first_not_of(blanks); at != std::string_view::npos;
       at = data.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(data.find_first_of(blanks, at), data.size());
    Number value{};
    if (!parse(data.substr(at, end - at), value)) {
      scan_.refuse_at(array.begin + at,
                      "expected a number of the array '" + array.name + "', found \"" +
                          std::string(data.substr(at, std::min<std::size_t>(40, end - at))) + "\"");
    }
    result.push_back(value);
    at = end;
  }
  if (count && std::ssize(result) != *count) {
    refuse(array, "holds " + std::to_string(result.size()) + " numbers, not " + std::to_string(*count));
  }
  return result;
}

template <class Number>
std::vector<Number> VtuNumbers::numbers(const VtuArray& array, std::optional<std::int64_t> count) const {
  std::size_t size = 0;
  if (!with_type(array.type, [&]<class T>(T) { size = sizeof(T); }))
    refuse(array, "has the type '" + array.type + "', which is no number's");
  if (array.format == "ascii") return ascii_numbers<Number>(array, count);
  std::optional<std::size_t> byte_count;
  if (count) byte_count = *count * size;
  return converted<Number>(array, bytes(array, byte_count));
}

std::vector<double> VtuNumbers::reals(const VtuArray& array, std::optional<std::int64_t> count) const {
  return numbers<double>(array, count);
}

std::vector<std::int64_t> VtuNumbers::integers(const VtuArray& array,
                                               std::optional<std::int64_t> count) const {
  return numbers<std::int64_t>(array, count);
}

std::vector<std::string> VtuNumbers::texts(const VtuArray& array) const {
  std::vector<std::string> texts;
  std::string text;
  for (const std::int64_t code : numbers<std::int64_t>(array, {})) {
    if (code != 0) {
      text += static_cast<char>(code);
    } else {
      texts.push_back(std::move(text));
      text.clear();
    }
  }
  return texts;
}

}  // namespace quadloop::io
