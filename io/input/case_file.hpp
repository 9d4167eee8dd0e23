#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// Which numbers a key may take. Values that are not finite are never in range.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is out
  bool high_open = false;  ///< high itself is out

  static Range positive() { return {0, std::numeric_limits<double>::infinity(), true, false}; }
  bool contains(double value) const;
  std::string text() const;
};

/// One table of a case file. Refusals are InputErrors that begin with the place: "case.toml:12: " or, for
/// what came from the command line, "--set spacing.min=x: ". Which keys a table may have is not its concern
/// (quadloop/case/key_table). A view: cheap to copy, and it keeps the file's data alive.
class CaseTable {
 public:
  struct Data;  ///< of the whole file; toml++ stays behind it
  CaseTable(std::shared_ptr<Data> data, const void* table, std::string path);

  CaseTable root() const;  ///< of the same file

  bool has(const std::string& key) const;
  bool is_table(const std::string& key) const;
  bool is_text(const std::string& key) const;
  std::optional<double> number(const std::string& key, const Range& range = {}) const;
  std::optional<std::int64_t> whole(const std::string& key, const Range& range) const;
  std::optional<std::string> text(const std::string& key) const;
  std::optional<bool> flag(const std::string& key) const;
  /// The word, which the key has. Throws InputError with the nearest of the words unless it is one of them.
  std::string known_word(const std::string& key, const std::string& word,
                         const std::vector<std::string>& words) const;
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count,
                                             const Range& range = {}) const;
  /// Both "a" and ["a", "b"] are lists of texts, both 1 and [1, 2] lists of numbers.
  std::vector<std::string> texts(const std::string& key) const;
  std::vector<double> numbers_or_one(const std::string& key, const Range& range = {}) const;
  /// A list of points, [x, y] or [[x, y], ...].
  std::vector<std::vector<double>> pairs(const std::string& key) const;

  std::optional<CaseTable> table(const std::string& key) const;
  /// Every [[key]], in the order of the file.
  std::vector<CaseTable> tables(const std::string& key) const;
  /// Those of this table, in the order of the file.
  std::vector<std::string> keys() const;

  /// Where the key stands (this table, if it is absent), for messages of the caller's own.
  std::string place(const std::string& key) const;
  std::string place() const;
  /// All values below this table with all assignments, by their dotted names in alphabetical order, each
  /// value as JSON on one line; without the keys and tables of the dotted names given. The same for every way
  /// to write the same case.
  std::vector<std::pair<std::string, std::string>> values(const std::vector<std::string>& without) const;
  /// The value of a key, which the table has, as values() gives it.
  std::string json(const std::string& key) const;
  /// The dotted name of a key.
  std::string full_name(const std::string& key) const;
  /// Notes a warning of the file, which begins with the place of the key as a refusal does.
  void warn(const std::string& key, const std::string& message) const;
  const std::vector<std::string>& warnings() const;  ///< those of all tables
  [[noreturn]] void refuse(const std::string& key, const std::string& message) const;

 private:
  std::shared_ptr<Data> data_;
  const void* table_;
  std::string path_;
};

/// Whether a word of the command line is KEY=VALUE, its key a path of TOML keys: neither an option nor the
/// path of a file.
bool is_assignment(std::string_view word);

/// Reads a case file (TOML) and lays `assignments` ("spacing.min=0.1", as --set has them) over it, in their
/// order. A value is TOML, or a plain text where it is not. Throws InputError "file:line: ...". On the
/// calling rank alone.
CaseTable read_case(const std::string& path, const std::vector<std::string>& assignments = {});

}  // namespace quadloop
