#include "io/dxf/dxf_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/trimmed.hpp"

namespace quadloop::io {

namespace {

/// Takes a line from the text; LF, CRLF and CR end it.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = trimmed(text.substr(0, end));
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
  return line;
}

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

}  // namespace

DxfText::DxfText(std::string path) : path_{std::move(path)}, text_{read_input(path_)} {
  if (text_.starts_with("AutoCAD Binary DXF"))
    throw InputError(path_ + ": is a binary DXF, which is not read; export it as ASCII DXF");
  std::string_view rest = text_;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  while (rest.find_first_not_of(" \t\r\n") != std::string_view::npos) {
    DxfGroup group;
    if (!parse_whole(take_line(rest), group.code))
      refuse_damaged(groups_.data() + groups_.size(), "a group code is expected here");
    group.value = take_line(rest);
    groups_.push_back(group);
    if (group.code == 0 && group.value == "EOF") return;
  }
}

std::string DxfText::place(const DxfGroup* group) const {
  return fmt::format("{}:{}", path_, 2 * (group - groups_.data()) + 1);
}

void DxfText::refuse_damaged(const DxfGroup* group, const std::string& what) const {
  throw InputError(
      fmt::format("{}: {}; the drawing is truncated or damaged, export it again", place(group), what));
}

const DxfGroup* DxfRecord::find(int code) const {
  const auto found = std::ranges::find(groups_, code, &DxfGroup::code);
  return found == groups_.end() ? nullptr : &*found;
}

std::string_view DxfRecord::text(int code) const {
  const DxfGroup* const group = find(code);
  return group == nullptr ? std::string_view() : group->value;
}

double DxfRecord::real_of(const DxfGroup& group) const {
  double value = 0;
  if (!parse_real(group.value, value) || !std::isfinite(value))
    refuse(fmt::format("'{}' of group {} is not a finite number", group.value, group.code));
  return value;
}

double DxfRecord::real(int code, double fallback) const {
  const DxfGroup* const group = find(code);
  return group == nullptr ? fallback : real_of(*group);
}

std::int64_t DxfRecord::whole(int code, std::int64_t fallback) const {
  const DxfGroup* const group = find(code);
  std::int64_t value = fallback;
  if (group != nullptr && !parse_whole(group->value, value))
    refuse(fmt::format("'{}' of group {} is not a whole number", group->value, code));
  return value;
}

std::string DxfRecord::source() const {
  const std::string_view handle = text(5);
  return fmt::format("{}: layer '{}', {}{}{}", text_->place(groups_.data()), layer(), type(),
                     handle.empty() ? " without handle" : " of handle ", handle);
}

void DxfRecord::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: {}; correct or delete this entity", source(), what));
}

}  // namespace quadloop::io
