#include "io/text/text_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

TextScanner::TextScanner(std::string path, char comment) : TextScanner(path, read_input(path), comment) {}

TextScanner::TextScanner(std::string path, std::string text, char comment)
    : path_{std::move(path)}, text_{std::move(text)}, comment_{comment} {
  at_ = token_ = comments_begin_ = text_.data();
  end_ = at_ + text_.size();
}

void TextScanner::skip() { at_ = next_token(at_, end_, comment_); }

bool TextScanner::at_end() {
  skip();
  return at_ == end_;
}

std::string_view TextScanner::token(std::string_view expected) {
  skip();
  token_ = at_;
  at_ = end_of_token(at_, end_);
  if (token_ == at_) refuse("the file ends where " + std::string(expected) + " should follow");
  return {token_, at_};
}

std::int64_t TextScanner::integer(std::string_view expected) {
  const std::string_view text = token(expected);
  std::int64_t value = 0;
  if (!parse_integer(text, value)) refuse(why_no_integer(text, expected));
  return value;
}

double TextScanner::real(std::string_view expected) {
  const std::string_view text = token(expected);
  double value = 0;
  if (!parse_real(text, value) || !std::isfinite(value)) refuse(why_no_finite_real(text, expected));
  return value;
}

std::size_t TextScanner::count(const std::string& of, std::size_t width) {
  const std::int64_t value = integer("the number of " + of);
  if (const std::string fault = why_no_count(value, of, width, bytes_left()); !fault.empty()) refuse(fault);
  return value;
}

bool TextScanner::at_line_end() {
  while (at_ != end_ && *at_ != '\n' && is_space(*at_)) ++at_;
  return at_ == end_ || *at_ == '\n' || *at_ == comment_;
}

std::string_view TextScanner::rest_of_line() {
  if (at_line_end()) return {};
  token_ = at_;
  const char* last = at_;
  for (; at_ != end_ && *at_ != '\n'; ++at_) {
    if (is_space(*at_)) continue;
    if (*at_ == comment_ && is_space(at_[-1])) break;
    last = at_ + 1;
  }
  return {token_, last};
}

std::string_view TextScanner::last_comment_with(std::string_view text) const {
  return io::last_comment_with(text, {comments_begin_, at_}, comment_);
}

std::string TextScanner::place_text(std::size_t place) const {
  const auto line = 1 + std::count(text_.data(), text_.data() + place, '\n');
  return path_ + ":" + std::to_string(line);
}

void TextScanner::refuse_at(std::size_t place, const std::string& message) const {
  throw InputError(place_text(place) + ": " + message);
}

}  // namespace quadloop::io
