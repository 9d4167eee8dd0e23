#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// How tables print a value without a unit.
constexpr const char* number_pattern = "{:.6g}";

/// The rows of a list that are printed, unless all are asked for.
constexpr std::size_t most_listed = 20;

/// The figures that a command ends with. Each is a row of the table that people read, rounded and with its
/// unit, and a member of the record that
/// `--json` prints, in full. A figure's key is its name in the table with "_" for each blank, unless another
/// is given.
class Figures {
 public:
  void add(const std::string& name, std::int64_t count);
  /// `pattern` is how the table prints the value: "{:.2f} degrees".
  void add(const std::string& name, double value, const char* pattern, const std::string& key = {});
  /// `text` for the table; `json` for the record, JSON already.
  void add_raw(const std::string& name, const std::string& text, const std::string& json,
               const std::string& key = {});
  /// Where the figure before is found: a row of the table, and [x, y] in the record.
  void add_place(Point place, const std::string& key);
  /// A member of the record alone; lines of the table alone.
  void add_member(const std::string& key, const std::string& json) {
    figures_.push_back({{}, key, {}, json});
  }
  void add_lines(const std::string& lines) { figures_.push_back({{}, {}, lines, {}}); }

  /// The names in a column of `width`, the values in one of `value_width`, to the right.
  std::string table(int width = 16, int value_width = 14) const;
  JsonObject record() const;

 private:
  struct Figure {
    std::string name, key, text, json;
  };
  std::vector<Figure> figures_;
};

}  // namespace quadloop
