#include "io/su2/su2_ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/reading/relay.hpp"
#include "io/model/file_part.hpp"
#include "io/model/matching_sides.hpp"
#include "io/model/plane_part.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/su2/su2_text.hpp"
#include "io/text/name_index.hpp"
#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/base/trimmed.hpp"

namespace quadloop::io {

namespace {

constexpr char su2_comment = '%';
constexpr std::string_view blanks = " \t\r\v\f";

/// A line "KEY= value".
struct KeyLine {
  std::string key, value;
  std::int64_t rows = 0;  ///< between it and the next one, on the ranks considered
};

/// The keys on a rank's lines.
struct KeysOfRank {
  std::vector<KeyLine> keys;
  std::int64_t rows_before = 0;         ///< before the first key
  std::array<std::string, 2> blocks{};  ///< name in the first comment on a block before that key; after it
};

template <class Pipe>
void pass_fields(Pipe& pipe, KeyLine& line) {
  pass(pipe, line.key, line.value, line.rows);
}
template <class Pipe>
void pass_fields(Pipe& pipe, KeysOfRank& keys) {
  pass(pipe, keys.keys, keys.rows_before, keys.blocks[0], keys.blocks[1]);
}

/// The tokens of one line.
class Row {
 public:
  explicit Row(std::string_view line) : at_{line.data()}, end_{line.data() + line.size()} {}

  bool at_end() {
    at_ = next_token(at_, end_, su2_comment);
    return at_ == end_;
  }
  /// Empty at the end.
  std::string_view token() {
    const char* const begin = next_token(at_, end_, su2_comment);
    at_ = end_of_token(begin, end_);
    return {begin, at_};
  }

 private:
  const char* at_;
  const char* end_;
};

/// What the rows after a key are.
enum class Rows : std::uint8_t { others, points, cells, edges };

class Su2Ranges {
 public:
  Su2Ranges(const Communicator& comm, const std::string& path, std::size_t piece)
      : comm_{comm}, path_{path}, range_{comm, path, piece} {}

  LoadedMesh read() {
    find_keys();
    comm_.together([&] {
      find_layout();
      read_rows();
    });
    FilePart part(comm_, path_, in_even_shares(comm_, std::move(points_)));
    triangles_ = in_even_shares(comm_, std::move(triangles_), 3);
    quads_ = in_even_shares(comm_, std::move(quads_), 4);
    const std::int64_t triangles = comm_.sum(std::ssize(triangles_)) / 3,
                       quads = comm_.sum(std::ssize(quads_)) / 4;
    part.set_blocks({block_.empty() ? "domain" : block_}, {&triangles, 1}, {&quads, 1});
    part.add_triangles(std::exchange(triangles_, {}));
    part.add_quads(std::exchange(quads_, {}));
    add_boundaries(part);
    LoadedMesh loaded = part.finish({});
    complete_plane_part(comm_, loaded, path_);
    // Periodic sides are specified only in the configuration.
    loaded.periodic_nodes = nodes_of_matching_sides(comm_, loaded.mesh);
    return loaded;
  }

 private:
  struct Marker {
    std::string name;
    std::int64_t edges;
  };

  void require(bool usual) const {
    if (!usual) throw InputError(path_ + ": is not read by ranges");
  }

  /// Calls `key(line, place of the "=")`, `row(line)`, and `remark(line)` for this rank's lines.
  template <class Key, class OfRow, class Remark>
  void for_each_line(const Key& key, const OfRow& row, const Remark& remark) {
    for (std::int64_t place = range_.begin(); place < range_.end();) {
      std::string_view text = range_.piece_at(place);
      place += std::ssize(text);
      while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::size_t equals = line.find('=');
        const bool is_key = equals != std::string_view::npos &&
                            line.substr(0, equals).find(su2_comment) == std::string_view::npos;
        if (is_key)
          key(line, equals);
        else
          Row(line).at_end() ? remark(line) : row(line);
      }
    }
  }

  /// All ranks get all keys.
  void find_keys() {
    KeysOfRank own;
    comm_.together([&] {
      for_each_line(
          [&](std::string_view line, std::size_t equals) {
            own.keys.push_back({std::string(trimmed(line.substr(0, equals), blanks)),
                                std::string(trimmed(line.substr(equals + 1), blanks))});
          },
          [&](std::string_view) { ++(own.keys.empty() ? own.rows_before : own.keys.back().rows); },
          [&](std::string_view line) {
            if (own.keys.size() > 1 || !line.starts_with(su2_block_comment)) return;
            std::string& name = own.blocks[own.keys.size()];
            if (name.empty()) name = trimmed(line.substr(std::string_view(su2_block_comment).size()), blanks);
          });
    });
    std::vector<KeysOfRank> all = gather_values(comm_, own);
    for (int rank = 0; rank < comm_.size(); ++rank) {
      if (rank == comm_.rank()) first_key_ = keys_.size();
      append(std::move(all[rank]));
    }
  }

  /// Appends the keys of the next rank.
  void append(KeysOfRank next) {
    if (keys_.empty())
      rows_before_ += next.rows_before;
    else
      keys_.back().rows += next.rows_before;
    for (std::size_t after = 0; after < 2; ++after) {  // that of a zone follows its first key
      if (keys_.size() + after == 1 && block_.empty()) block_ = next.blocks[after];
    }
    std::ranges::move(next.keys, std::back_inserter(keys_));
  }

  static std::int64_t number_in(std::string_view text) {
    std::int64_t number = -1;
    return parse_integer(text, number) ? number : -1;
  }

  /// Requires the keys of a plane mesh of one zone, with as many rows as they say.
  void find_layout() {
    std::int64_t dimension = -1, cells = -1, tags = 0, markers = 0;
    std::string tag;
    require(rows_before_ == 0);
    const auto set_once = [&](std::int64_t& number, std::string_view value) {
      require(number == -1);
      number = number_in(value);
      require(number >= 0);
    };
    for (const auto& [key, value, rows] : keys_) {
      Rows& kind = kinds_.emplace_back(Rows::others);
      require(key != "NZONE" && key != "IZONE");
      if (key == "NDIME") set_once(dimension, value);
      if (key == "NMARK") set_once(marker_count_, value);
      if (key == "NELEM") {
        set_once(cells, value);
        require(cells == rows && cells > 0);
        kind = Rows::cells;
      } else if (key == "NPOIN") {
        set_once(nodes_, value.substr(0, value.find_first_of(" \t")));
        require(nodes_ == rows && is_counts(value));
        kind = Rows::points;
      } else if (key == "MARKER_TAG") {
        require(tag.empty() && !value.empty() && value.find(su2_comment) == std::string::npos);
        tag = value;
        ++tags;
      } else if (key == "MARKER_ELEMS") {
        require(!tag.empty() && tag != "SEND_RECEIVE" && number_in(value) == rows);
        markers_.push_back({std::exchange(tag, {}), rows});
        kind = Rows::edges;
        ++markers;
      }
    }
    require(dimension == 2 && cells > 0 && nodes_ >= 0 && tag.empty() && markers == tags);
    require(marker_count_ == tags && tags > 0);
  }

  /// NPOIN may have a second number.
  static bool is_counts(std::string_view value) {
    Row row(value);
    std::int64_t number = 0;
    for (int count = 0; count < 2 && !row.at_end(); ++count) {
      if (!parse_integer(row.token(), number)) return false;
    }
    return row.at_end();
  }

  void read_rows() {
    std::size_t next_key = first_key_;
    for_each_line([&](std::string_view, std::size_t) { ++next_key; },
                  [&](std::string_view line) {
                    switch (kinds_[next_key - 1]) {
                      case Rows::others: return;
                      case Rows::points: return read_point(Row(line));
                      case Rows::cells: return read_element(Row(line));
                      case Rows::edges: return read_edge(Row(line));
                    }
                  },
                  [](std::string_view) {});
  }

  /// As in SU2, a number after the coordinates is ignored.
  void read_point(Row row) {
    Point p;
    require(parse_real(row.token(), p.x) && parse_real(row.token(), p.y) && std::isfinite(p.x) &&
            std::isfinite(p.y));
    while (!row.at_end()) require(row.token().find_first_not_of("0123456789") == std::string_view::npos);
    points_.push_back(p);
  }

  void read_element(Row row) {
    const std::int64_t type = number_in(row.token());
    require(type == vtk_triangle || type == vtk_quad);
    if (type == vtk_triangle)
      read_nodes(row, 3, triangles_);
    else
      read_nodes(row, 4, quads_);
  }

  void read_edge(Row row) {
    require(number_in(row.token()) == vtk_line);
    read_nodes(row, 2, edges_);
  }

  /// The row may end with its own number.
  void read_nodes(Row row, int width, std::vector<GlobalNodeId>& nodes) const {
    for (int k = 0; k < width; ++k) {
      const std::int64_t node = number_in(row.token());
      require(node >= 0 && node < nodes_);
      nodes.emplace_back(node);
    }
    std::int64_t own_number = 0;
    require(row.at_end() || (parse_integer(row.token(), own_number) && row.at_end()));
  }

  /// Markers of the same name form one boundary.
  void add_boundaries(FilePart& part) {
    NameIndex known;
    std::vector<std::int32_t> entries;
    std::vector<std::int64_t> counts;
    for (const auto& [name, edges] : markers_) {
      const auto [entry, is_new] = known.entry_of(name);
      if (is_new) part.add_boundary(name, {}, {});
      entries.push_back(entry);
      counts.push_back(edges);
    }
    part.set_edges(in_even_shares(comm_, std::move(edges_), 2), entries, counts);
  }

  const Communicator& comm_;
  const std::string& path_;
  LineRange range_;
  std::vector<KeyLine> keys_;  ///< of all ranks
  std::vector<Rows> kinds_;    ///< of the rows after each of them
  std::size_t first_key_ = 0;  ///< of this rank
  std::int64_t rows_before_ = 0, nodes_ = -1, marker_count_ = -1;
  std::string block_;
  std::vector<Marker> markers_;
  // of this rank's lines:
  std::vector<Point> points_;
  std::vector<GlobalNodeId> triangles_, quads_, edges_;
};

}  // namespace

LoadedMesh read_su2_ranges(const Communicator& comm, const std::string& path, std::size_t piece) {
  return Su2Ranges(comm, path, piece).read();
}

}  // namespace quadloop::io
