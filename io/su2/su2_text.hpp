#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/text/text_scanner.hpp"

namespace quadloop::io {

/// What a comment with the name of a zone begins with; it follows the line "IZONE= n".
inline constexpr const char* su2_block_comment = "% block ";

/// A line "KEY= value", by positions in the text; it is followed by the rows of the key.
struct Su2Key {
  std::string key;
  std::size_t begin = 0, value = 0;
};

/// The text of an SU2 mesh of any dimension: its keys, in any order, with the rows after each. Errors are
/// InputErrors "file:line: ...".
class Su2Text {
 public:
  /// Finds the keys.
  explicit Su2Text(const std::string& path);

  TextScanner& scan() { return scan_; }
  const std::vector<Su2Key>& keys() const { return keys_; }

  /// Number of zones (NZONE, IZONE), at least one; numbered from 0. All functions below refer to the current
  /// zone, initially 0; its points are numbered after those of earlier zones.
  std::size_t zones() const { return zone_begins_.size() - 1; }
  void go_to_zone(std::size_t zone);
  /// Returns the name in a comment after its first line; empty if there is none.
  std::string name_of_zone() const;

  /// NDIME.
  std::int64_t dimension();

  /// Return the line of a key; keys().size() if the zone has none, which is an error in the second function.
  std::size_t find(const std::string& key) const;
  std::size_t find_one(const std::string& key) const;
  void go_to_value(std::size_t key, const std::string& expected);
  std::int64_t number_of(std::size_t key, const std::string& expected);
  /// Returns the number of rows that follow, of at least `width` numbers each.
  std::size_t count_of(std::size_t key, const std::string& of, std::size_t width);
  void end_of_key_line();

  /// Reads NPOIN: calls `begin(count)`, then `put(coordinates)` for each point. As in SU2, what follows the
  /// coordinates in a row is ignored.
  void read_points(std::size_t dimension, const std::function<void(std::size_t)>& begin,
                   const std::function<void(const double*)>& put);
  /// Reads the next node in a row.
  std::int32_t node_in_row();
  /// The row of an element may end with its own number, which is redundant.
  void end_row();
  /// The rows of a key must be followed by the next key, or the end.
  void check_rows_end_before(std::size_t next);

  /// Calls `read(key of its MARKER_ELEMS, its name)` for each marker. Markers named SEND_RECEIVE, from the
  /// ranks of old versions of SU2, are skipped.
  void read_markers(const std::function<void(std::size_t, const std::string&)>& read);

  /// Returns what was ignored, one line each with the file's name.
  std::vector<std::string> warnings() const;

 private:
  void find_keys();
  void find_zones();
  std::size_t zone_begin() const { return zone_begins_[zone_]; }
  std::size_t zone_end() const { return zone_begins_[zone_ + 1]; }
  /// End of the zone's text.
  std::size_t end_of_zone() const;
  void pass_over_rest_of_point();
  void expect_in_row(const std::string& expected);
  void check_marker_count(std::size_t tags);

  TextScanner scan_;
  std::vector<Su2Key> keys_;
  std::vector<std::size_t> zone_begins_;  ///< their first keys, and the number of all keys
  std::size_t zone_ = 0;
  std::int64_t first_point_ = 0, points_ = 0;  ///< of the zone
  std::int64_t odd_rows_ = 0, passed_markers_ = 0;
  std::size_t first_odd_row_ = 0;  ///< its position
};

}  // namespace quadloop::io
