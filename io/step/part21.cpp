#include "io/step/part21.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/files/reading/input_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

using Kind = Part21Value::Kind;

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

/// Reads the text of a STEP file once, from its beginning to its end.
class Part21Parser {
 public:
  explicit Part21Parser(Part21File& file) : file_{file}, text_{file.text_} {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }

  void read() {
    if (keyword() != "ISO-10303-21")
      refuse("does not begin with ISO-10303-21 as a STEP file does; export it again");
    expect(';');
    while (true) {
      const std::string_view section = keyword();
      if (section == "END-ISO-10303-21") return;
      if (section == "DATA")
        read_data();
      else if (section.empty())
        refuse(fmt::format("a section is expected, but {} is written{}", found(), cure));
      else
        skip_section();
    }
  }

 private:
  static constexpr const char* cure = "; the file is truncated or damaged, export it again";

  void read_data() {
    skip_blanks();
    const std::size_t values = file_.values_.size();
    if (next_is('(')) read_list(0);
    file_.values_.resize(values);
    expect(';');
    while (true) {
      skip_blanks();
      if (next_is('#')) {
        read_entity();
      } else {
        if (keyword() != "ENDSEC")
          refuse("an entity '#number=' or ENDSEC is expected, but " + found() + " is written" + cure);
        expect(';');
        return;
      }
    }
  }

  void read_entity() {
    const std::uint64_t number = reference();
    number_ = number;
    const auto value = static_cast<std::uint32_t>(file_.values_.size());
    const auto index = static_cast<std::uint32_t>(file_.entities_.size());
    if (!file_.index_.try_emplace(number, index).second)
      refuse("occurs twice; the file is damaged, export it again");
    file_.entities_.push_back({number, static_cast<std::uint32_t>(line()), value});
    expect('=');
    skip_blanks();
    if (next_is('('))
      read_records();
    else
      read_record(0);
    expect(';');
    number_.reset();
  }

  /// The records of a complex instance.
  void read_records() {
    const std::size_t list = add(Kind::list);
    expect('(');
    skip_blanks();
    while (!next_is(')')) {
      read_record(0);
      skip_blanks();
    }
    expect(')');
    close(list);
  }

  void read_record(int depth) {
    skip_blanks();
    const std::string_view type = keyword();
    if (type.empty()) refuse("the type of an entity is expected, but " + found() + " is written" + cure);
    const std::size_t record = add(Kind::record, type);
    read_parts(depth);
    close(record);
  }

  void read_list(int depth) {
    const std::size_t list = add(Kind::list);
    read_parts(depth);
    close(list);
  }

  void read_parts(int depth) {
    if (depth > deepest_nesting) refuse(fmt::format("lists are nested deeper than {}", deepest_nesting));
    expect('(');
    skip_blanks();
    if (!next_is(')')) {
      read_value(depth);
      for (skip_blanks(); next_is(','); skip_blanks()) {
        ++at_;
        read_value(depth);
      }
    }
    expect(')');
  }

  void read_value(int depth) {
    skip_blanks();
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if (c == '(') return read_list(depth + 1);
    if (is_letter(c) || c == '!') return read_record(depth + 1);
    const std::size_t value = c == '#' ? add_number(Kind::reference, static_cast<double>(reference()))
                              : c == '\'' || c == '"' ? add(Kind::text, quoted(c))
                              : c == '.'              ? add(Kind::word, word())
                              : c == '$' || c == '*'  ? add(c == '$' ? Kind::omitted : Kind::derived)
                                                      : add_number(Kind::number, number());
    if (c == '$' || c == '*') ++at_;
    close(value);
  }

  std::size_t add(Kind kind, std::string_view text = {}) {
    file_.values_.push_back({kind, 0, 0, text});
    return file_.values_.size() - 1;
  }
  std::size_t add_number(Kind kind, double number) {
    file_.values_.push_back({kind, 0, number, {}});
    return file_.values_.size() - 1;
  }
  void close(std::size_t value) {
    file_.values_[value].end = static_cast<std::uint32_t>(file_.values_.size());
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || (c >= '\t' && c <= '\r')) {
        ++at_;
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) refuse(std::string("a comment does not end") + cure);
        at_ = end + 2;
      } else {
        return;
      }
    }
  }

  /// The next keyword; empty if there is none.
  std::string_view keyword() {
    skip_blanks();
    const std::size_t begin = at_;
    const auto belongs = [&](char c) { return is_letter(c) || (at_ > begin && (is_digit(c) || c == '-')); };
    if (next_is('!')) ++at_;
    while (at_ < text_.size() && (belongs(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::uint64_t reference() {
    constexpr std::uint64_t largest = std::uint64_t{1} << 53;
    expect('#');
    std::uint64_t number = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (error == std::errc::result_out_of_range || number > largest)
      refuse(fmt::format("the number of an entity is larger than {}", largest));
    if (error != std::errc()) refuse("a number is expected after '#', but " + found() + " is written" + cure);
    at_ += end - begin;
    return number;
  }

  std::string_view quoted(char quote) {
    const std::size_t begin = at_ + 1;
    while (true) {
      const std::size_t end = text_.find(quote, at_ + 1);
      if (end == std::string_view::npos) refuse(std::string("a text does not end") + cure);
      at_ = end + 1;
      if (!next_is(quote)) return text_.substr(begin, end - begin);
    }
  }

  std::string_view word() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    expect('.');
    return word;
  }

  double number() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (is_digit(text_[at_]) || std::string_view("+-.eE").find(text_[at_]) != std::string_view::npos))
      ++at_;
    const std::string_view written = text_.substr(begin, at_ - begin);
    double value = 0;
    if (written.empty()) refuse("a parameter is expected, but " + found() + " is written" + cure);
    if (!parse_real(written, value) || !std::isfinite(value))
      refuse(fmt::format("'{}' is not a number of double precision", written.substr(0, 40)));
    return value;
  }

  bool next_is(char c) const { return at_ < text_.size() && text_[at_] == c; }
  void expect(char c) {
    skip_blanks();
    if (!next_is(c)) refuse(fmt::format("'{}' is expected, but {} is written{}", c, found(), cure));
    ++at_;
  }

  void skip_section() {
    while (keyword() != "ENDSEC") {
      skip_blanks();
      if (at_ >= text_.size()) refuse(std::string("a section does not end with ENDSEC") + cure);
      if (next_is('\'') || next_is('"'))
        quoted(text_[at_]);
      else
        ++at_;
    }
    expect(';');
  }

  std::string found() const {
    if (at_ >= text_.size()) return "the end of the file";
    const unsigned char c = text_[at_];
    return c > ' ' && c < 127 ? fmt::format("'{}'", text_[at_]) : fmt::format("the byte {:#04x}", c);
  }

  /// The line of the current place.
  std::int64_t line() {
    line_ += std::count(text_.begin() + counted_, text_.begin() + at_, '\n');
    counted_ = at_;
    return line_;
  }

  [[noreturn]] void refuse(const std::string& message) {
    throw InputError(fmt::format("{}:{}: {}{}", file_.path_, line(),
                                 number_ ? fmt::format("#{}: ", *number_) : "", message));
  }

  Part21File& file_;
  std::string_view text_;
  std::size_t at_ = 0, counted_ = 0;
  std::int64_t line_ = 1;
  std::optional<std::uint64_t> number_;  ///< of the entity that is being read
};

Part21File::Part21File(std::string path) : path_{std::move(path)}, text_{read_input(path_)} {
  if (text_.size() >= std::numeric_limits<std::uint32_t>::max())
    throw InputError(path_ + ": has 4 GB or more; export only the curves or the face to be meshed");
  Part21Parser(*this).read();
}

StepEntity Part21File::entity(std::size_t index) const { return {*this, static_cast<std::uint32_t>(index)}; }

std::optional<StepEntity> Part21File::find(std::uint64_t number) const {
  const auto found = index_.find(number);
  return found == index_.end() ? std::nullopt : std::optional(StepEntity(*this, found->second));
}

void StepValue::refuse(std::string_view expected) const {
  StepEntity(*file_, entity_)
      .refuse(fmt::format("{} is expected as a parameter; the file is damaged, export it again", expected));
}

bool StepValue::is_omitted() const { return kind() == Kind::omitted || kind() == Kind::derived; }

double StepValue::number() const {
  if (kind() == Kind::record && value().end == value_ + 2)
    return StepValue(*file_, entity_, value_ + 1).number();
  if (kind() != Kind::number) refuse("a number");
  return value().number;
}

int StepValue::small_integer() const {
  constexpr double largest = 1e9;
  const double value = number();
  if (value != std::floor(value) || std::abs(value) > largest) refuse("an integer");
  return static_cast<int>(value);
}

std::string StepValue::text() const {
  if (is_omitted()) return {};
  if (kind() != Kind::text) refuse("a text");
  return text_of_part21(value().text);
}

std::string_view StepValue::word() const {
  if (is_omitted()) return {};
  if (kind() != Kind::word) refuse("a word such as .T.");
  return value().text;
}

bool StepValue::flag() const {
  const std::string_view word = kind() == Kind::word ? value().text : "";
  if (word != "T" && word != "F") refuse(".T. or .F.");
  return word == "T";
}

StepEntity StepValue::entity() const {
  if (kind() != Kind::reference) refuse("a reference to an entity");
  const auto number = static_cast<std::uint64_t>(value().number);
  if (const std::optional<StepEntity> found = file_->find(number)) return *found;
  StepEntity(*file_, entity_)
      .refuse(fmt::format("refers to #{}, which is not in the file; export it again", number));
}

StepValues StepValue::list() const {
  if (kind() != Kind::list) refuse("a list");
  return {*file_, entity_, value_ + 1, value().end};
}

bool StepValue::is_record(std::string_view type) const {
  return kind() == Kind::record && value().text == type;
}

StepValues::Iterator& StepValues::Iterator::operator++() {
  at_ = values_->file_->values_[at_].end;
  return *this;
}

std::size_t StepValues::size() const {
  std::size_t count = 0;
  for (Iterator i = begin(); i != end(); ++i) ++count;
  return count;
}

StepValue StepValues::operator[](std::size_t i) const {
  const StepValues rest = after(i);
  if (rest.begin_ == rest.end_)
    StepEntity(*file_, entity_).refuse("has too few parameters; the file is damaged, export it again");
  return *rest.begin();
}

StepValues StepValues::after(std::size_t count) const {
  StepValues rest = *this;
  for (; count > 0 && rest.begin_ != end_; --count) rest.begin_ = file_->values_[rest.begin_].end;
  return rest;
}

std::string_view StepEntity::type() const {
  if (!is_complex()) return root().text;
  return root().end > entity().value + 1 ? file_->values_[entity().value + 1].text : "";
}

std::optional<StepValues> StepEntity::record(std::string_view type) const {
  const std::uint32_t first = entity().value + (is_complex() ? 1 : 0);
  for (std::uint32_t at = first; at < root().end; at = file_->values_[at].end) {
    if (file_->values_[at].text == type) return StepValues(*file_, index_, at + 1, file_->values_[at].end);
  }
  return std::nullopt;
}

bool StepEntity::is(std::string_view type) const { return record(type).has_value(); }

StepValues StepEntity::own(std::string_view type, std::size_t inherited) const {
  if (!is_complex()) return StepValues(*file_, index_, entity().value + 1, root().end).after(inherited);
  if (const auto found = record(type)) return *found;
  refuse(fmt::format("has no record {}; the file is damaged, export it again", type));
}

void StepEntity::require(std::string_view type) const {
  if (!is(type)) refuse(fmt::format("an entity {} is expected here; export the file again", type));
}

std::string StepEntity::name() const {
  if (is_complex() && !is("REPRESENTATION_ITEM")) return {};
  const StepValues values = own("REPRESENTATION_ITEM", 0);
  if (!(values.begin() != values.end()) || values[0].kind() != Kind::text) return {};
  std::string name = values[0].text();
  name.erase(0, name.find_first_not_of(" \t"));
  name.erase(name.find_last_not_of(" \t") + 1);
  return name == "NONE" ? "" : name;
}

std::string StepEntity::title() const { return fmt::format("{} #{}", type(), number()); }
std::string StepEntity::place() const {
  return fmt::format("{}:{}: {}", file_->path_, entity().line, title());
}
void StepEntity::refuse(const std::string& message) const { throw InputError(place() + ": " + message); }

}  // namespace quadloop::io
