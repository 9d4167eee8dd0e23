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

/// The text of an SU2 mesh: its keys, in any order, and the rows after each, whatever the dimension. Refusals
/// are InputErrors "file:line: ...".
class Su2Text {
 public:
  /// Finds the keys.
  explicit Su2Text(const std::string& path);

  TextScanner& scan() { return scan_; }
  const std::vector<Su2Key>& keys() const { return keys_; }

  /// How many zones there are (NZONE, IZONE), at least one; they are numbered from 0. All that follows is of
  /// the zone that was gone to last, at first 0; its points are numbered after those of the zones before.
  std::size_t zones() const { return zone_begins_.size() - 1; }
  void go_to_zone(std::size_t zone);

  /// NDIME.
  std::int64_t dimension();

  /// The line of a key; keys().size() where the zone has none, for the second a refusal.
  std::size_t find(const std::string& key) const;
  std::size_t find_one(const std::string& key) const;
  void go_to_value(std::size_t key, const std::string& expected);
  std::int64_t number_of(std::size_t key, const std::string& expected);
  /// The number of rows that follow, of so many numbers at least.
  std::size_t count_of(std::size_t key, const std::string& of, std::size_t width);
  void end_of_key_line();

  /// NPOIN: `begin(count)`, then `put(coordinates)` for each point. As in SU2, what follows the coordinates
  /// in a row is ignored.
  void read_points(std::size_t dimension, const std::function<void(std::size_t)>& begin,
                   const std::function<void(const double*)>& put);
  /// The next node in a row.
  std::int32_t node_in_row();
  /// A row of an element may end with its own number, which says nothing new.
  void end_row();
  /// After the rows of a key comes the next key, or the end.
  void check_rows_end_before(std::size_t next);

  /// Each marker: `read(key of its MARKER_ELEMS, its name)`. Those with the name SEND_RECEIVE, of the ranks
  /// of old versions of SU2, are passed over.
  void read_markers(const std::function<void(std::size_t, const std::string&)>& read);

  /// What was ignored, a line each with the file's name.
  std::vector<std::string> warnings() const;

 private:
  void find_keys();
  void find_zones();
  std::size_t zone_begin() const { return zone_begins_[zone_]; }
  std::size_t zone_end() const { return zone_begins_[zone_ + 1]; }
  /// Where the zone's text ends.
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
  std::size_t first_odd_row_ = 0;  ///< its place
};

}  // namespace quadloop
