#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input/case_source.hpp"

namespace quadloop::io {

/// Valid range of a number. Values that are not finite are never in range.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is excluded
  bool high_open = false;  ///< high itself is excluded

  static Range positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }
  bool contains(double value) const;
  std::string text() const;
};

/// A table of a case file. Errors are InputErrors that begin with the location: "case.toml:12: " or, for the
/// command line, "--set spacing.min=x: ". The valid keys of a table are defined elsewhere
/// (quadloop/case/key_table). A view: cheap to copy, and it keeps the file's data alive.
class CaseTable {
 public:
  struct Data;  ///< of the whole file; hides toml++
  CaseTable(std::shared_ptr<Data> data, const void* table, std::string path);

  CaseTable root() const;  ///< of the same file

  bool has(const std::string& key) const;
  bool is_table(const std::string& key) const;
  bool is_text(const std::string& key) const;
  std::optional<double> number(const std::string& key, const Range& range = {}) const;
  std::optional<std::int64_t> whole(const std::string& key, const Range& range) const;
  std::optional<std::string> text(const std::string& key) const;
  std::optional<bool> flag(const std::string& key) const;
  /// Returns the value of a key, which must exist. Throws InputError with the nearest valid word unless it is
  /// one of them.
  std::string known_word(const std::string& key, const std::string& word,
                         const std::vector<std::string>& words) const;
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count,
                                             const Range& range = {}) const;
  /// Both "a" and ["a", "b"] are lists of strings, both 1 and [1, 2] lists of numbers.
  std::vector<std::string> texts(const std::string& key) const;
  std::vector<double> numbers_or_one(const std::string& key, const Range& range = {}) const;
  /// A list of points, [x, y] or [[x, y], ...].
  std::vector<std::vector<double>> pairs(const std::string& key) const;

  std::optional<CaseTable> table(const std::string& key) const;
  /// Every [[key]], in the order of the file.
  std::vector<CaseTable> tables(const std::string& key) const;
  /// Returns the keys of this table, in the order of the file.
  std::vector<std::string> keys() const;

  /// Returns the location of the key (of this table, if it is absent), for messages.
  std::string place(const std::string& key) const;
  std::string place() const;
  /// Returns all values below this table, including assignments, by their dotted names in alphabetical order,
  /// each as JSON on one line; without the given dotted keys and tables. Independent of the way the case is
  /// written.
  std::vector<std::pair<std::string, std::string>> values(const std::vector<std::string>& without) const;
  /// Returns the value of a key, which must exist, in the format of values().
  std::string json(const std::string& key) const;
  /// Returns the dotted name of a key.
  std::string full_name(const std::string& key) const;
  /// Adds a warning about the file that begins with the location of the key, as errors do.
  void warn(const std::string& key, const std::string& message) const;
  const std::vector<std::string>& warnings() const;  ///< of all tables
  [[noreturn]] void refuse(const std::string& key, const std::string& message) const;

 private:
  std::shared_ptr<Data> data_;
  const void* table_;
  std::string path_;
};

/// Whether a word of the command line is KEY=VALUE with a TOML key path: neither an option nor the path of a
/// file.
bool is_assignment(std::string_view word);

/// Reads a case (TOML) and applies `assignments` ("spacing.min=0.1", from --set) in their order. A value is
/// TOML, else plain text. On the calling rank only. Throws InputError "file:line: ...".
CaseTable read_case(const CaseSource& source, const std::vector<std::string>& assignments = {});

}  // namespace quadloop::io
