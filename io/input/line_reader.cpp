#include "io/input/line_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "io/files/input_file.hpp"
#include "io/text/decimal_comma.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// The old end-of-file character (0x1A) of DOS is a blank too.
bool is_blank(char c) {
  return c == '\x1a' || c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == ',';
}

constexpr std::string_view between_numbers = " \t\r\f\v;";  // of a row whose commas are decimal ones

/// The number that is the whole word; infinite where it is too large for a double; nothing where it is no
/// number.
std::optional<double> number_of(std::string_view word) {
  double value = 0;
  return parse_real(word, value) ? std::optional(value) : std::nullopt;
}

}  // namespace

LineReader::LineReader(const std::string& path) : path_{path}, text_{read_input(path)} {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // the byte order mark of some editors
}

bool LineReader::next() {
  while (at_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    row_ = std::string_view(text_).substr(at_, end - at_);
    at_ = end + 1;
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

}  // namespace quadloop
