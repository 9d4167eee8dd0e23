#include "io/foam/foam_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/files/reading/input_file.hpp"
#include "io/text/text_scanner.hpp"
#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

bool is_sign(char c) { return std::string_view("(){};").find(c) != std::string_view::npos; }

std::string read_foam_text(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored) && std::filesystem::exists(path + ".gz", ignored))
    throw InputError(path + ".gz: is compressed; unpack it first (gunzip)");
  return read_input(path);
}

}  // namespace

FoamScanner::FoamScanner(std::string path) : path_{std::move(path)}, text_{read_foam_text(path_)} {
  skip_header();
}

void FoamScanner::skip() {
  while (at_ < text_.size()) {
    const std::string_view rest = std::string_view(text_).substr(at_);
    if (is_space(rest.front())) {
      ++at_;
    } else if (rest.starts_with("//")) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text_.find("*/", at_ + 2);
      at_ = end == std::string::npos ? text_.size() : end + 2;
    } else {
      return;
    }
  }
}

bool FoamScanner::at_end() {
  skip();
  return at_ == text_.size();
}

std::string_view FoamScanner::token(std::string_view expected) {
  skip();
  token_ = at_;
  if (at_ == text_.size()) refuse("the file ends where " + std::string(expected) + " should follow");
  if (is_sign(text_[at_])) {
    ++at_;
  } else if (text_[at_] == '"') {
    at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
  } else {
    while (at_ < text_.size() && !is_space(text_[at_]) && !is_sign(text_[at_])) ++at_;
  }
  return std::string_view(text_).substr(token_, at_ - token_);
}

void FoamScanner::expect(std::string_view sign) {
  const std::string_view found = token(sign);
  if (found != sign)
    refuse("expected \"" + std::string(sign) + "\", found \"" + std::string(found.substr(0, 40)) + "\"");
}

std::int64_t FoamScanner::integer(std::string_view expected) {
  const std::string_view found = token(expected);
  std::int64_t value = 0;
  const auto [stopped, error] = std::from_chars(found.data(), found.data() + found.size(), value);
  if (error != std::errc{} || stopped != found.data() + found.size())
    refuse("expected " + std::string(expected) + ", found \"" + std::string(found.substr(0, 40)) + "\"");
  return value;
}

double FoamScanner::real(std::string_view expected) {
  const std::string_view found = token(expected);
  double value = 0;
  if (!parse_real(found, value) || !std::isfinite(value))
    refuse("expected " + std::string(expected) + ", found \"" + std::string(found.substr(0, 40)) + "\"");
  return value;
}

std::size_t FoamScanner::begin_list(const std::string& of, std::size_t bytes_each) {
  const std::int64_t count = integer("the number of " + of);
  const std::size_t left = text_.size() - at_;
  if (count < 0 || count > std::numeric_limits<std::int32_t>::max() ||
      static_cast<std::size_t>(count) * bytes_each > left)
    refuse("the file cannot hold its " + std::to_string(count) + " " + of +
           "; it is cut short, or this count is wrong");
  expect("(");
  return count;
}

void FoamScanner::end_file() {
  expect(")");
  if (!at_end()) {
    token("");
    refuse("text after the end of the list");
  }
}

/// "FoamFile { format ascii; ... }".
void FoamScanner::skip_header() {
  if (token("FoamFile") != "FoamFile") refuse("is no file of OpenFOAM: it does not begin with FoamFile");
  expect("{");
  for (std::string_view key = token("}"); key != "}"; key = token("}")) {
    const std::string_view value = token("a value");
    if (key == "format" && value != "ascii")
      refuse("is " + std::string(value) + "; only ascii can be read: foamFormatConvert writes it so");
    if (value != ";") expect(";");
  }
}

void FoamScanner::refuse(const std::string& message) const {
  const auto line =
      1 + std::count(text_.begin(),
                     text_.begin() + static_cast<std::ptrdiff_t>(std::min(token_, text_.size())), '\n');
  throw InputError(path_ + ":" + std::to_string(line) + ": " + message);
}

}  // namespace quadloop::io
