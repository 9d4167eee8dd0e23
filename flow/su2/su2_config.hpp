#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadloop {

/// A configuration of SU2: lines "KEY= value", keys in any case, '%' begins a comment. A line that ends with
/// a backslash goes on in the next one. Everything that is not set anew stays as its user wrote it.
class Su2Config {
 public:
  /// Throws InputError, which begins with `path` and a line's number, where a line is none of these or a key
  /// is there twice: SU2 refuses both.
  Su2Config(const std::string& text, const std::string& path);

  /// Without blanks around it and without its comment; none where the key is not there.
  std::optional<std::string> value(const std::string& key) const;
  /// The words of a value, which blanks, commas and parentheses divide; none where the key is not there.
  std::vector<std::string> words(const std::string& key) const;

  /// In the place of its old value; a new key comes last.
  void set(const std::string& key, const std::string& value);

  std::string text() const;

 private:
  struct Line {
    std::string text;  ///< as it stands, several where it goes on
    std::string key;   ///< in capitals; empty where it has none
    std::string value;
  };

  Line* find(const std::string& key);

  std::vector<Line> lines_;
};

}  // namespace quadloop
