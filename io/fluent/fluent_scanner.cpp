#include "io/fluent/fluent_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace quadloop::io {

namespace {

bool is_fluent_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool FluentScanner::at_end() {
  while (at_ < scan_.text().size() && is_fluent_blank(scan_.text()[at_])) ++at_;
  return at_ == scan_.text().size();
}

std::string_view FluentScanner::token(std::string_view expected) {
  const bool nothing = at_end();
  token_ = at_;
  if (nothing) refuse("the file ends where " + std::string(expected) + " should follow");
  const std::string_view text = scan_.text();
  const auto is_sign = [](char c) { return c == '(' || c == ')'; };
  if (is_sign(text[at_])) {
    ++at_;
  } else if (text[at_] == '"') {
    ++at_;
    while (at_ < text.size() && (text[at_] != '"' || text[at_ - 1] == '\\')) ++at_;
    at_ = std::min(at_ + 1, text.size());
  } else {
    while (at_ < text.size() && !is_fluent_blank(text[at_]) && !is_sign(text[at_])) ++at_;
  }
  return text.substr(token_, at_ - token_);
}

std::string_view FluentScanner::peek() {
  if (at_end()) return {};
  const std::size_t at = at_, before = token_;
  const std::string_view found = token("");
  at_ = at;
  token_ = before;
  return found;
}

bool FluentScanner::is_number_next() {
  const std::string_view next = peek();
  return !next.empty() && (next.front() == '-' || (next.front() >= '0' && next.front() <= '9'));
}

void FluentScanner::expect(std::string_view sign) {
  const std::string_view found = token("\"" + std::string(sign) + "\"");
  if (found != sign)
    refuse("expected \"" + std::string(sign) + "\", found \"" + std::string(found.substr(0, 40)) + "\"");
}

std::int64_t FluentScanner::integer(std::string_view expected, int base) {
  const std::string_view found = token(expected);
  std::int64_t value = 0;
  const auto [stopped, error] = std::from_chars(found.data(), found.data() + found.size(), value, base);
  if (error != std::errc{} || stopped != found.data() + found.size())
    refuse("expected " + std::string(expected) + ", found \"" + std::string(found.substr(0, 40)) + "\"");
  return value;
}

double FluentScanner::real(std::string_view expected) {
  const std::string_view found = token(expected);
  double value = 0;
  if (!parse_real(found, value) || !std::isfinite(value))
    refuse("expected " + std::string(expected) + ", found \"" + std::string(found.substr(0, 40)) + "\"");
  return value;
}

void FluentScanner::skip_list() {
  for (std::int64_t open = 1; open > 0;) {
    const std::string_view found = token("\")\"");
    if (found == "(") ++open;
    if (found == ")") --open;
  }
}

}  // namespace quadloop::io
