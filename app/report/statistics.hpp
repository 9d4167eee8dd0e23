#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::app {

/// Format of a value without a unit.
constexpr const char* number_pattern = "{:.6g}";

/// Maximum number of printed rows of a list, unless all are requested.
constexpr std::size_t most_listed = 20;

/// The results of a command. Each is a row of the table, rounded and with its unit, and a member of the
/// record that `--json` prints, in full precision. The key of a result is its name in the table with "_" for
/// each blank, unless another is given.
class Statistics {
 public:
  void add(const std::string& name, std::int64_t count);
  /// `pattern` is the format in the table: "{:.2f} degrees".
  void add(const std::string& name, double value, const char* pattern, const std::string& key = {});
  /// `text` for the table; `json` for the record, already JSON.
  void add_raw(const std::string& name, const std::string& text, const std::string& json,
               const std::string& key = {});
  /// Adds the location of the previous result: a row of the table, and [x, y] in the record.
  void add_place(Point place, const std::string& key);
  /// Add a member to the record only; add lines to the table only.
  void add_member(const std::string& key, const std::string& json) {
    statistics_.push_back({{}, key, {}, json});
  }
  void add_lines(const std::string& lines) { statistics_.push_back({{}, {}, lines, {}}); }

  /// Formats the names in a column of `width`, the values right-aligned in one of `value_width`.
  std::string table(int width = 16, int value_width = 14) const;
  JsonObject record() const;

 private:
  struct Figure {
    std::string name, key, text, json;
  };
  std::vector<Figure> statistics_;
};

}  // namespace quadloop::app
