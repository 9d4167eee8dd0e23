#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadloop::flow {

/// Returns a key in upper case, as SU2 compares keys.
std::string su2_key(std::string text);

/// Returns a number that a whole word denotes; empty if it denotes none, or one that is not finite.
std::optional<double> su2_number(const std::string& word);

/// An SU2 configuration: lines "KEY= value", keys in any case, '%' begins a comment. A line that ends with a
/// backslash continues on the next one. Everything that is not set remains as the user wrote it.
class Su2Config {
 public:
  /// Throws InputError, which begins with `path` and a line number, for any other line and for a duplicate
  /// key, which SU2 rejects too.
  Su2Config(const std::string& text, const std::string& path);

  /// Returns the value without surrounding blanks and comment; empty if there is no such key.
  std::optional<std::string> value(const std::string& key) const;
  /// Returns the words of a value, separated by blanks, commas and parentheses; empty if there is no such
  /// key.
  std::vector<std::string> words(const std::string& key) const;

  /// Replaces the value of a key; a new key is appended.
  void set(const std::string& key, const std::string& value);

  std::string text() const;

 private:
  struct Line {
    std::string text;  ///< unchanged text; several lines if continued
    std::string key;   ///< in upper case; empty if there is none
    std::string value;
  };

  Line* find(const std::string& key);

  std::vector<Line> lines_;
};

}  // namespace quadloop::flow
