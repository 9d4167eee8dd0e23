#include "io/gis/dxf_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

template <class Number>
Number number_in(std::string_view text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The pairs of lines of a drawing: a code, and a value.
class DxfPairs {
 public:
  explicit DxfPairs(std::string_view text) : text_{text} {}

  /// Returns false at the end, and if a line that should be a group code is not a number.
  bool next() {
    begin_ = at_;
    const std::string_view code = line();
    if (std::from_chars(code.data(), code.data() + code.size(), code_).ec != std::errc()) return false;
    value_ = line();
    return true;
  }
  int code() const { return code_; }
  std::string_view value() const { return value_; }
  bool is(int code, std::string_view value) const { return code_ == code && value_ == value; }
  std::size_t begin() const { return begin_; }  ///< position of the pair in the text
  bool at_end() const { return trimmed(text_.substr(begin_)).empty(); }
  std::int64_t line_number() const { return 1 + std::ranges::count(text_.substr(0, begin_), '\n'); }
  std::size_t end() const { return at_; }

 private:
  std::string_view line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view found = trimmed(text_.substr(at_, end - at_));
    at_ = std::min(end + 1, text_.size());
    return found;
  }

  std::string_view text_, value_;
  std::size_t at_ = 0, begin_ = 0;
  int code_ = 0;
};

/// The names of a drawing's layers, or of its blocks: equal ones may differ in case.
class DxfNames {
 public:
  /// The first spelling of the name; the name itself where it is new.
  const std::string& spelling_of(std::string_view name) {
    return names_.try_emplace(small_letters(std::string(name)), name).first->second;
  }
  bool contains(std::string_view name) const { return names_.contains(small_letters(std::string(name))); }
  std::vector<std::string> all() const {
    std::vector<std::string> spellings;
    for (const auto& [lower, name] : names_) spellings.push_back(name);
    return spellings;
  }

 private:
  std::map<std::string, std::string> names_;  ///< by lower case
};

/// Calls `take` for each pair within a section, with the section's name and the type of the table entry or
/// entity that the pair belongs to.
template <class Take>
void for_each_pair(std::string_view text, Take take) {
  DxfPairs pairs(text);
  std::string_view section, type;
  while (pairs.next()) {
    if (pairs.is(0, "SECTION")) {
      if (!pairs.next()) return;
      section = pairs.value();
    }
    if (pairs.code() == 0) type = pairs.value();
    take(pairs, section, type);
  }
}

/// What a drawing defines.
struct DxfDefinitions {
  DxfNames layers, blocks;

  explicit DxfDefinitions(std::string_view text) {
    constexpr int external = 4;  // a flag of a block: its content is in another file
    std::string_view block;
    bool is_head = false;
    for_each_pair(text, [&](const DxfPairs& pair, std::string_view section, std::string_view type) {
      if (section == "TABLES" && type == "LAYER" && pair.code() == 2) layers.spelling_of(pair.value());
      if (section != "BLOCKS") return;
      if (pair.code() == 0) {
        if (is_head && !block.empty()) blocks.spelling_of(block);
        is_head = type == "BLOCK";
        block = {};
      } else if (is_head && pair.code() == 2) {
        block = pair.value();
      } else if (is_head && pair.code() == 70 && (number_in<int>(pair.value()) & external) != 0) {
        is_head = false;
      }
    });
  }
};

/// One entity while its pairs are read.
struct PartEntity {
  DxfEntity entity;
  std::string handle;
  DxfSpline spline;
  std::int64_t fit_points = 0;

  void take(const DxfPairs& pair) {
    const auto real = [&] { return number_in<double>(pair.value()); };
    switch (pair.code()) {
      case 5: handle = pair.value(); break;
      case 8: entity.layer = pair.value(); break;
      default: break;
    }
    if (entity.type != "SPLINE") return;
    switch (pair.code()) {
      case 71: spline.degree = number_in<int>(pair.value()); break;
      case 40: spline.knots.push_back(real()); break;
      case 41: spline.weights.push_back(real()); break;
      case 10: spline.controls.push_back({real(), 0}); break;
      case 20:
        if (!spline.controls.empty()) spline.controls.back().y = real();
        break;
      case 11: ++fit_points; break;
      default: break;
    }
  }
};

/// Returns the unit for a value of $INSUNITS.
std::string unit_named(int value) {
  constexpr std::array<const char*, 17> names{"",   "inch",   "foot",      "mile", "mm",   "cm",
                                              "m",  "km",     "microinch", "mil",  "yard", "angstrom",
                                              "nm", "micron", "dm",        "dam",  "hm"};
  return value > 0 && value < static_cast<int>(names.size()) ? names[value] : "";
}

void refuse_binary(const std::string& path, std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw InputError(path + ": is a binary DXF, which is not read; export it as ASCII DXF");
}

/// GDAL 3.6 loops forever on some drawings that end within a section, or have none.
[[noreturn]] void refuse_damaged(const std::string& path, const DxfPairs& pairs, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}; the drawing is truncated or damaged, export it again", path,
                               pairs.line_number(), what));
}

/// Returns the curve's point at `t`, in the knot span that begins at `span`.
Point point_at(const DxfSpline& spline, std::size_t span, double t) {
  struct Weighted {
    Point p;
    double w;
  };
  const std::size_t degree = spline.degree;
  std::vector<Weighted> d;
  for (std::size_t i = span - degree; i <= span; ++i) {
    const double w = spline.weights.empty() ? 1 : spline.weights[i];
    d.push_back({w * spline.controls[i], w});
  }
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t j = degree; j >= r; --j) {
      const double low = spline.knots[span - degree + j], high = spline.knots[span + 1 + j - r];
      const double a = (t - low) / (high - low);
      d[j] = {(1 - a) * d[j - 1].p + a * d[j].p, (1 - a) * d[j - 1].w + a * d[j].w};
    }
  }
  return 1 / d[degree].w * d[degree].p;
}

bool is_sound(const DxfSpline& spline) {
  const std::size_t degree = spline.degree, controls = spline.controls.size();
  return spline.degree >= 1 && spline.degree <= 25 && controls > degree &&
         spline.knots.size() == controls + degree + 1 && std::ranges::is_sorted(spline.knots) &&
         (spline.weights.empty() || spline.weights.size() == controls) &&
         std::ranges::all_of(spline.weights, [](double w) { return w > 0; });
}

}  // namespace

std::vector<Point> points_of(const DxfSpline& spline) {
  constexpr int smooth = 16;  // segments between two knots
  std::vector<Point> points;
  if (!is_sound(spline)) return points;
  const int segments = spline.degree == 1 ? 1 : smooth;
  std::size_t last = 0;
  for (std::size_t span = spline.degree; span < spline.controls.size(); ++span) {
    const double low = spline.knots[span], high = spline.knots[span + 1];
    if (!(low < high)) continue;
    for (int k = 0; k < segments; ++k)
      points.push_back(point_at(spline, span, low + (high - low) * k / segments));
    last = span;
  }
  if (!points.empty()) points.push_back(point_at(spline, last, spline.knots[last + 1]));
  return points;
}

bool DxfDrawing::correct_names(std::string& text) {
  DxfDefinitions defined(text);
  layers_ = defined.layers.all();
  bool any = false;
  const auto spell = [&](std::string_view name, const std::string& spelling) {
    if (name == spelling) return;
    any = true;
    std::ranges::copy(spelling, text.begin() + (name.data() - text.data()));  // only the case differs
  };
  std::string layer;
  for_each_pair(text, [&](const DxfPairs& pair, std::string_view section, std::string_view type) {
    if (section != "BLOCKS" && section != "ENTITIES") return;
    if (pair.code() == 8) {
      layer = defined.layers.spelling_of(pair.value());
      spell(pair.value(), layer);
    }
    if (type != "INSERT" || pair.code() != 2) return;
    if (defined.blocks.contains(pair.value()))
      spell(pair.value(), defined.blocks.spelling_of(pair.value()));
    else
      missing_blocks_.emplace_back(pair.value(), layer);
  });
  return any;
}

DxfDrawing::DxfDrawing(const std::string& path) {
  std::string text = read_input(path);
  refuse_binary(path, text);
  const bool is_corrected = correct_names(text);
  DxfPairs pairs(text);
  std::string section, first_section, variable;
  std::size_t section_begin = 0;
  PartEntity part;
  const auto keep = [&] {
    if (part.fit_points > 0 && part.spline.controls.empty())
      throw InputError(fmt::format(
          "{}: layer '{}': the spline of handle {} is given by fit points alone; export it with its "
          "control points, or as a polyline",
          path, part.entity.layer, part.handle));
    if (part.entity.type == "SPLINE") part.entity.spline = std::move(part.spline);
    if (!part.handle.empty()) entities_[part.handle] = std::move(part.entity);
    part = {};
  };
  while (pairs.next() && !pairs.is(0, "EOF")) {
    if (pairs.is(0, "SECTION")) {
      if (!section.empty()) break;
      section_begin = pairs.begin();
      if (!pairs.next()) break;
      section = pairs.value();
      if (first_section.empty()) first_section = section;
    } else if (pairs.is(0, "ENDSEC")) {
      if (section == "ENTITIES") {
        keep();
        if (first_section != "HEADER" && first_section != "ENTITIES")
          corrected_ = text.substr(section_begin, pairs.end() - section_begin) + "  0\nEOF\n";
      }
      section.clear();
    } else if (section == "ENTITIES") {
      if (pairs.code() == 0) {
        keep();
        part.entity.type = pairs.value();
      } else {
        part.take(pairs);
      }
    } else if (section == "HEADER") {
      if (pairs.code() == 9) variable = pairs.value();
      if (pairs.code() == 70 && variable == "$INSUNITS") unit_ = unit_named(number_in<int>(pairs.value()));
    }
  }
  if (!section.empty()) refuse_damaged(path, pairs, "section " + section + " does not end with ENDSEC");
  if (!pairs.at_end() && !pairs.is(0, "EOF")) refuse_damaged(path, pairs, "a group code is expected here");
  if (first_section.empty()) refuse_damaged(path, pairs, "there is no SECTION");
  if (corrected_.empty() && is_corrected) corrected_ = std::move(text);
}

const DxfEntity* DxfDrawing::find(const std::string& handle) const {
  const auto found = entities_.find(handle);
  return found == entities_.end() ? nullptr : &found->second;
}

}  // namespace quadloop::io
