#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "io/files/reading/line_range.hpp"
#include "io/files/reading/relay.hpp"
#include "io/su2/su2_csv_file.hpp"
#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/base/parallel/row_move.hpp"
#include "mesher/base/trimmed.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::io {

namespace {

/// Names of columns may be quoted.
constexpr std::string_view blanks_and_quotes = " \t\r\"";

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',', begin)) {
    fields.push_back(trimmed(line.substr(begin, comma - begin), blanks_and_quotes));
    begin = comma + 1;
  }
  const std::string_view last = trimmed(line.substr(begin), blanks_and_quotes);
  if (!last.empty() || fields.empty()) fields.push_back(last);  // a line may end with a comma
  return fields;
}

/// A line of the file that is not empty, and its number, from 1.
struct NumberedLine {
  std::string text;
  std::int64_t number = 0;
};

/// The lines on a rank.
struct LinesOfRank {
  std::vector<NumberedLine> first;      ///< at most two
  std::int64_t all = 0, not_empty = 0;  ///< their numbers
};

template <class Pipe>
void pass_fields(Pipe& pipe, NumberedLine& line) {
  pass(pipe, line.text, line.number);
}
template <class Pipe>
void pass_fields(Pipe& pipe, LinesOfRank& lines) {
  pass(pipe, lines.first, lines.all, lines.not_empty);
}

/// Each rank reads the rows on its lines.
class Su2CsvReader {
 public:
  Su2CsvReader(const Communicator& comm, const std::string& path)
      : comm_{comm}, path_{path}, range_{comm, path} {
    loaded_.path = path;
  }

  LoadedSolution read() {
    find_lines();
    comm_.together([&] {
      read_header();
      read_rows();
      if (loaded_.nodes == 0) refuse(last_line_, "the table has no rows");
    });
    sort_rows();
    const auto width = std::ssize(loaded_.solution.names);
    loaded_.solution.values = in_even_shares(comm_, std::move(loaded_.solution.values), width);
    loaded_.points = in_even_shares(comm_, std::move(loaded_.points));
    return std::move(loaded_);
  }

 private:
  [[noreturn]] void refuse(std::int64_t line, const std::string& message) const {
    throw InputError(path_ + ":" + std::to_string(line) + ": " + message);
  }

  /// Calls `visit(line, number on this rank)` for lines that are not empty. Returns the number of line ends.
  template <class Visit>
  std::int64_t for_each_line(const Visit& visit) {
    std::int64_t ends = 0;
    for (std::int64_t place = range_.begin(); place < range_.end();) {
      std::string_view text = range_.piece_at(place);
      place += std::ssize(text);
      while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (!trimmed(line, blanks_and_quotes).empty()) visit(line, ends);
        if (line.size() < text.size()) ++ends;
        text.remove_prefix(std::min(line.size() + 1, text.size()));
      }
    }
    return ends;
  }

  /// All ranks get the header and the first row.
  void find_lines() {
    LinesOfRank own;
    comm_.together([&] {
      own.all = for_each_line([&](std::string_view line, std::int64_t number) {
        ++own.not_empty;
        if (own.first.size() < 2) own.first.push_back({std::string(line), number});
      });
    });
    std::vector<LinesOfRank> all = gather_values(comm_, own);
    for (int rank = 0; rank < comm_.size(); ++rank) {
      LinesOfRank& lines = all[rank];
      if (rank == comm_.rank()) {
        first_line_ = last_line_;
        first_row_ = loaded_.nodes;
      }
      for (NumberedLine& line : lines.first) {
        if (first_.size() < 2) first_.push_back({std::move(line.text), last_line_ + line.number});
      }
      last_line_ += lines.all;
      loaded_.nodes += lines.not_empty;
    }
    if (loaded_.nodes > 0) --loaded_.nodes;  // without the header
    if (first_row_ > 0) --first_row_;
  }

  void read_header() {
    if (first_.empty()) refuse(1, "the file is empty");
    const std::int64_t line = first_[0].number;
    for (const std::string_view name : fields_of(first_[0].text)) {
      const std::string key = lower(name);
      const std::size_t column = names_.size();
      names_.emplace_back(name);
      double number = 0;
      if (name.empty() || parse_real(name, number))
        refuse(line, "the first line must name the columns, as \"PointID\",\"x\",\"y\",\"Density\"");
      if (key == "pointid") {
        id_column_ = column;
      } else if (key == "x") {
        x_column_ = column;
      } else if (key == "y") {
        y_column_ = column;
      } else if (key == "z") {
        z_column_ = column;
      } else {
        variables_.push_back(column);
        loaded_.solution.names.emplace_back(name);
      }
    }
    if (variables_.empty())
      refuse(line, "the table has no variables; give each a column beside PointID, x and y");
    if (x_column_.has_value() != y_column_.has_value())
      refuse(line, "of the coordinates only one of x and y is there");
  }

  void read_rows() {
    find_plane();
    for_each_line([&](std::string_view line, std::int64_t ends) {
      const std::int64_t number = first_line_ + ends;
      if (number > first_[0].number) read_row(line, number);
    });
  }

  /// All nodes must have the z of the first row; where that has none, it is refused on its rank.
  void find_plane() {
    if (!z_column_ || first_.size() < 2) return;
    const std::vector<std::string_view> texts = fields_of(first_[1].text);
    double z = 0;
    if (*z_column_ < texts.size() && parse_real(texts[*z_column_], z)) plane_ = z;
  }

  void read_row(std::string_view text, std::int64_t line) {
    const std::vector<std::string_view> texts = fields_of(text);
    if (texts.size() != names_.size()) {
      refuse(line, fmt::format("{} values stand under {} names; the file is cut short, or the row is",
                               texts.size(), names_.size()));
    }
    ++own_rows_;
    row_.resize(texts.size());
    for (std::size_t k = 0; k < texts.size(); ++k) {
      if (!parse_real(texts[k], row_[k])) {
        refuse(line,
               fmt::format("expected a number for {}, found \"{}\"", names_[k], texts[k].substr(0, 40)));
      }
      if (!std::isfinite(row_[k]))
        refuse(line, fmt::format("{} is not finite: {}, in row {} of the nodes", names_[k],
                                 texts[k].substr(0, 40), first_row_ + own_rows_));
    }
    for (const std::size_t column : variables_) loaded_.solution.values.push_back(row_[column]);
    if (x_column_) loaded_.points.push_back({row_[*x_column_], row_[*y_column_]});
    if (z_column_ && plane_ && row_[*z_column_] != *plane_)
      refuse(line, fmt::format("z is {}, before {}; a mesh lies in a plane z = constant", row_[*z_column_],
                               *plane_));
    if (id_column_) ids_.push_back(row_[*id_column_]);
  }

  /// Moves each row to the position given by its PointID, unless all are there. *Collective.*
  void sort_rows() {
    bool moves = false;
    for (std::size_t i = 0; i < ids_.size(); ++i)
      moves = moves || ids_[i] != static_cast<double>(first_row_ + static_cast<std::int64_t>(i));
    if (!comm_.any(moves)) return;
    const std::vector<double> ids = gather_at_root(comm_, ids_);
    std::vector<std::int64_t> rows;  // in the order of their numbers
    comm_.together([&] {
      if (comm_.is_root()) rows = rows_by_id(ids);
    });
    rows = scatter_evenly(comm_, std::span<const std::int64_t>(rows));
    const RowMove move(comm_, first_row_, rows);
    loaded_.solution.values = move.forth(loaded_.solution.values, variables_.size());
    if (x_column_) loaded_.points = move.forth(loaded_.points);
  }

  std::vector<std::int64_t> rows_by_id(const std::vector<double>& ids) const {
    const std::int64_t rows = std::ssize(ids);
    std::vector<std::int64_t> row_of(rows, rows);
    for (std::int64_t row = 0; row < rows; ++row) {
      const double id = ids[row];
      if (id < 0 || id >= static_cast<double>(rows) || id != std::floor(id)) {
        refuse(last_line_,
               fmt::format("row {} has the PointID {}, which is none of 0 to {}; rows are missing", row + 1,
                           id, rows - 1));
      }
      std::int64_t& place = row_of[static_cast<std::size_t>(id)];
      if (place < rows)
        refuse(last_line_, fmt::format("rows {} and {} have the same PointID {}", place + 1, row + 1, id));
      place = row;
    }
    return row_of;
  }

  const Communicator& comm_;
  const std::string& path_;
  LineRange range_;
  std::vector<NumberedLine> first_;              ///< of the file: the header and the first row
  std::int64_t first_line_ = 1, last_line_ = 1;  ///< of this rank; the end of the file
  std::int64_t first_row_ = 0, own_rows_ = 0;    ///< of nodes, on this rank
  std::vector<std::string> names_;               ///< of all columns
  std::optional<std::size_t> id_column_, x_column_, y_column_, z_column_;
  std::vector<std::size_t> variables_;  ///< their columns
  std::vector<double> row_, ids_;
  std::optional<double> plane_;
  LoadedSolution loaded_;
};

}  // namespace

LoadedSolution read_su2_csv(const Communicator& comm, const std::string& path) {
  return Su2CsvReader(comm, path).read();
}

}  // namespace quadloop::io
