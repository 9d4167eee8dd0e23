#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/text/text_scanner.hpp"

namespace quadloop {

/// A line "KEY= value", by places in the text; the rows of the key follow it.
struct Su2Key {
  std::string key;
  std::size_t begin = 0, value = 0;
};

/// "12 (hexahedron)"
std::string su2_element_name(std::int64_t vtk_type);

/// The text of an SU2 mesh: its keys, in any order, and the rows after each, whatever the dimension. Refusals
/// are InputErrors "file:line: ...".
class Su2Text {
 public:
  /// Finds the keys.
  explicit Su2Text(const std::string& path);

  TextScanner& scan() { return scan_; }
  const std::vector<Su2Key>& keys() const { return keys_; }

  /// NDIME, of a file of one zone.
  std::int64_t dimension();

  /// The line of a key; keys().size() where the file has none, for the second a refusal.
  std::size_t find(const std::string& key) const;
  std::size_t find_one(const std::string& key) const;
  void go_to_value(std::size_t key, const std::string& expected);
  std::int64_t number_of(std::size_t key, const std::string& expected);
  /// The number of rows that follow, of so many numbers at least.
  std::size_t count_of(std::size_t key, const std::string& of, std::size_t width);
  void end_of_key_line();

  /// NPOIN: `begin(count)`, then `put(coordinates)` for each point.
  void read_points(std::size_t dimension, const std::function<void(std::size_t)>& begin,
                   const std::function<void(const double*)>& put);
  /// The next node in a row.
  std::int32_t node_in_row();
  /// A row may end with its own number, which says nothing new.
  void end_row();
  /// After the rows of a key comes the next key, or the end.
  void check_rows_end_before(std::size_t next);

  /// Each marker: `read(key of its MARKER_ELEMS, its name)`.
  void read_markers(const std::function<void(std::size_t, const std::string&)>& read);

 private:
  void find_keys();
  void expect_in_row(const std::string& expected);
  void check_marker_count(std::size_t tags);

  TextScanner scan_;
  std::vector<Su2Key> keys_;
  std::int64_t points_ = 0;
};

}  // namespace quadloop
