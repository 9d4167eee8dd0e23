#include "io/input/line_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "io/text/decimal_comma.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// Includes the DOS end-of-file character (0x1A).
bool is_blank(char c) {
  return c == '\x1a' || c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == ',';
}

constexpr std::string_view between_numbers = " \t\r\f\v;";  // in rows with decimal commas

/// Returns the number that is the whole word; infinity if it is too large for a double; empty if it is not a
/// number.
std::optional<double> number_of(std::string_view word) {
  double value = 0;
  return parse_real(word, value) ? std::optional(value) : std::nullopt;
}

enum class ByteOrder { none, low_first, high_first };

/// Of a text in UTF-16: by its byte order mark, else by the zeros that half of the bytes of most letters and
/// digits are; none where it is another text.
ByteOrder utf16_order(std::string_view text) {
  if (text.starts_with("\xFF\xFE")) return ByteOrder::low_first;
  if (text.starts_with("\xFE\xFF")) return ByteOrder::high_first;
  const std::string_view begin = text.substr(0, 256);
  std::array<std::size_t, 2> zeros{};  // at even and at odd places
  for (std::size_t i = 0; i < begin.size(); ++i) zeros[i % 2] += begin[i] == '\0' ? 1 : 0;
  const auto are_high = [&](std::size_t some, std::size_t others) {
    return others == 0 && some > 0 && 4 * some >= begin.size();
  };
  if (are_high(zeros[1], zeros[0])) return ByteOrder::low_first;
  return are_high(zeros[0], zeros[1]) ? ByteOrder::high_first : ByteOrder::none;
}

/// A byte order mark stays one in UTF-8. Characters beyond the first plane become '?': coordinates and names
/// have none.
std::string utf8_of_utf16(std::string_view text, ByteOrder order) {
  const std::size_t low = order == ByteOrder::low_first ? 0 : 1;
  std::string out;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    const unsigned unit = byte(low) | static_cast<unsigned>(byte(1 - low)) << 8U;
    if (unit < 0x80) {
      out += static_cast<char>(unit);
    } else if (unit >= 0xD800 && unit < 0xE000) {
      if (unit < 0xDC00) out += '?';
    } else {
      if (unit >= 0x800) out += static_cast<char>(0xE0U | unit >> 12U);
      out += static_cast<char>((unit >= 0x800 ? 0x80U | (unit >> 6U & 0x3FU) : 0xC0U | unit >> 6U));
      out += static_cast<char>(0x80U | (unit & 0x3FU));
    }
  }
  return out;
}

}  // namespace

LineReader::LineReader(const std::string& path) : path_{path}, file_{path} {
  fill();
  if (const ByteOrder order = utf16_order(text_); order != ByteOrder::none) {
    read_rest();
    text_ = utf8_of_utf16(text_, order);
    fill();
  }
  const bool has_old_line_ends = row_end_ == text_.size() && text_.find('\r') != std::string::npos;
  if (has_old_line_ends) {  // Mac line ends before 2001
    std::ranges::replace(text_, '\r', '\n');
    fill();
  }
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark of some editors
}

void LineReader::read_rest() {
  while (!all_read_) {
    const std::size_t before = text_.size();
    file_.append_next(text_);
    all_read_ = text_.size() == before;
  }
}

void LineReader::fill() {
  row_end_ = text_.find('\n', at_);
  while (row_end_ == std::string::npos && !all_read_) {
    text_.erase(0, std::exchange(at_, 0));
    const std::size_t before = text_.size();
    file_.append_next(text_);
    all_read_ = text_.size() == before;
    row_end_ = text_.find('\n', before);
  }
  if (row_end_ == std::string::npos) row_end_ = text_.size();
}

bool LineReader::next_point(Point& point) {
  fill();
  if (at_ >= text_.size()) return false;
  const char* at = text_.data() + at_;
  const char* const end = text_.data() + row_end_;
  for (double* const value : {&point.x, &point.y}) {
    while (at != end && is_blank(*at)) ++at;
    const auto [stopped, error] = std::from_chars(at, end, *value);
    if (error != std::errc{} || !std::isfinite(*value) || (stopped != end && !is_blank(*stopped)))
      return false;
    at = stopped;
  }
  while (at != end && is_blank(*at)) ++at;
  if (at != end) return false;
  at_ = row_end_ + 1;
  ++line_;
  return true;
}

std::size_t LineReader::most_points_left() const {
  const std::size_t held = text_.size() - std::min(at_, text_.size());
  return (held + file_.bytes_left()) / 4 + 1;  // "0 0" and a line end
}

bool LineReader::next() {
  while (fill(), at_ < text_.size()) {
    row_ = std::string_view(text_).substr(at_, row_end_ - at_);
    at_ = row_end_ + 1;
    ++line_;
    row_ = row_.substr(0, row_.find('#'));
    words_.clear();
    for (std::size_t i = 0; i < row_.size();) {
      while (i < row_.size() && is_blank(row_[i])) ++i;
      const std::size_t begin = i;
      while (i < row_.size() && !is_blank(row_[i])) ++i;
      if (i > begin) words_.push_back(row_.substr(begin, i - begin));
    }
    if (words_.size() > 2) refuse_decimal_commas();
    if (!words_.empty()) return true;
  }
  return false;
}

void LineReader::require_next(const std::string& expected) {
  if (!next())
    refuse(fmt::format("the file ends here, but {} is missing; it may have been cut off", expected));
}

void LineReader::refuse_decimal_commas() const {
  if (row_.find(',') == std::string_view::npos) return;
  std::vector<std::string_view> numbers;
  for (std::size_t i = row_.find_first_not_of(between_numbers); i < row_.size();
       i = row_.find_first_not_of(between_numbers, i)) {
    const std::size_t end = std::min(row_.find_first_of(between_numbers, i), row_.size());
    numbers.push_back(row_.substr(i, end - i));
    i = end;
  }
  std::string fault;
  for (const std::string_view number : numbers) {
    const std::string here = decimal_comma_in(number);
    if (here.empty() && !number_of(number)) return;
    if (fault.empty()) fault = here;
  }
  if (numbers.size() == 2 && !fault.empty()) refuse(fault);
}

double LineReader::real(std::size_t word) const {
  const auto value = number_of(words_[word]);
  if (!value) refuse(fmt::format("'{}' is not a number", words_[word]));
  if (!std::isfinite(*value)) refuse(fmt::format("'{}' is not a finite number", words_[word]));
  return *value;
}

std::int64_t LineReader::count(std::size_t word, const std::string& of_what) const {
  const std::string_view text = words_[word];
  std::int64_t value = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || stop != text.data() + text.size() || value < 1) {
    refuse(fmt::format("'{}' is not a number of {}; it must be a whole number from 1 on", text, of_what));
  }
  return value;
}

bool LineReader::is_number(std::size_t word) const { return number_of(words_[word]).has_value(); }

void LineReader::refuse(const std::string& message) const { throw InputError(place() + ": " + message); }

}  // namespace quadloop::io
