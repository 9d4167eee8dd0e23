#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/su2/su2_csv_file.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/trimmed.hpp"

namespace quadloop::io {

namespace {

/// Names of columns may be quoted.
constexpr std::string_view blanks_and_quotes = " \t\r\"";

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

class Su2CsvReader {
 public:
  explicit Su2CsvReader(const std::string& path) : scan_{path, TextScanner::no_comments} {
    loaded_.path = path;
  }

  LoadedSolution read() {
    read_header();
    while (next_line()) read_row();
    if (loaded_.nodes == 0) scan_.refuse_at(scan_.text().size(), "the table has no rows");
    if (id_column_) sort_rows();
    return std::move(loaded_);
  }

 private:
  /// Skips empty lines.
  bool next_line() {
    const std::string_view text = scan_.text();
    while (next_ < text.size()) {
      line_begin_ = next_;
      const std::size_t end = std::min(text.find('\n', line_begin_), text.size());
      next_ = end + 1;
      line_ = text.substr(line_begin_, end - line_begin_);
      if (!trimmed(line_, blanks_and_quotes).empty()) return true;
    }
    return false;
  }

  std::vector<std::string_view> fields() const {
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    for (std::size_t comma = line_.find(','); comma != std::string_view::npos;
         comma = line_.find(',', begin)) {
      fields.push_back(trimmed(line_.substr(begin, comma - begin), blanks_and_quotes));
      begin = comma + 1;
    }
    const std::string_view last = trimmed(line_.substr(begin), blanks_and_quotes);
    if (!last.empty() || fields.empty()) fields.push_back(last);  // a line may end with a comma
    return fields;
  }

  void read_header() {
    if (!next_line()) scan_.refuse_at(0, "the file is empty");
    for (const std::string_view name : fields()) {
      const std::string key = lower(name);
      const std::size_t column = names_.size();
      names_.emplace_back(name);
      double number = 0;
      if (name.empty() || parse_real(name, number))
        scan_.refuse_at(line_begin_,
                        "the first line must name the columns, as \"PointID\",\"x\",\"y\",\"Density\"");
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
      scan_.refuse_at(line_begin_, "the table has no variables; give each a column beside PointID, x and y");
    if (x_column_.has_value() != y_column_.has_value())
      scan_.refuse_at(line_begin_, "of the coordinates only one of x and y is there");
  }

  void read_row() {
    const std::vector<std::string_view> texts = fields();
    if (texts.size() != names_.size()) {
      scan_.refuse_at(line_begin_,
                      fmt::format("{} values stand under {} names; the file is cut short, or the row is",
                                  texts.size(), names_.size()));
    }
    row_.resize(texts.size());
    for (std::size_t k = 0; k < texts.size(); ++k) {
      if (!parse_real(texts[k], row_[k])) {
        scan_.refuse_at(line_begin_, fmt::format("expected a number for {}, found \"{}\"", names_[k],
                                                 texts[k].substr(0, 40)));
      }
      if (!std::isfinite(row_[k]))
        scan_.refuse_at(line_begin_, fmt::format("{} is not finite: {}, in row {} of the nodes", names_[k],
                                                 texts[k].substr(0, 40), loaded_.nodes + 1));
    }
    for (const std::size_t column : variables_) loaded_.solution.values.push_back(row_[column]);
    if (x_column_) loaded_.points.push_back({row_[*x_column_], row_[*y_column_]});
    if (z_column_) check_plane(row_[*z_column_]);
    if (id_column_) ids_.push_back(row_[*id_column_]);
    ++loaded_.nodes;
  }

  void check_plane(double z) {
    if (!plane_) plane_ = z;
    if (z != *plane_)
      scan_.refuse_at(line_begin_,
                      fmt::format("z is {}, before {}; a mesh lies in a plane z = constant", z, *plane_));
  }

  /// Moves each row to the position given by its PointID.
  void sort_rows() {
    const std::size_t rows = loaded_.nodes, width = variables_.size();
    std::vector<std::size_t> row_of(rows, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const double id = ids_[row];
      if (id < 0 || id >= static_cast<double>(rows) || id != std::floor(id)) {
        scan_.refuse_at(scan_.text().size(),
                        fmt::format("row {} has the PointID {}, which is none of 0 to {}; rows are missing",
                                    row + 1, id, rows - 1));
      }
      std::size_t& place = row_of[static_cast<std::size_t>(id)];
      if (place < rows)
        scan_.refuse_at(scan_.text().size(),
                        fmt::format("rows {} and {} have the same PointID {}", place + 1, row + 1, id));
      place = row;
    }
    if (std::is_sorted(row_of.begin(), row_of.end())) return;
    const LoadedSolution unsorted = loaded_;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < width; ++k)
        loaded_.solution.values[i * width + k] = unsorted.solution.values[row_of[i] * width + k];
      if (x_column_) loaded_.points[i] = unsorted.points[row_of[i]];
    }
  }

  TextScanner scan_;
  std::size_t next_ = 0, line_begin_ = 0;
  std::string_view line_;
  std::vector<std::string> names_;  ///< of all columns
  std::optional<std::size_t> id_column_, x_column_, y_column_, z_column_;
  std::vector<std::size_t> variables_;  ///< their columns
  std::vector<double> row_, ids_;
  std::optional<double> plane_;
  LoadedSolution loaded_;
};

}  // namespace

LoadedSolution read_su2_csv(const std::string& path) { return Su2CsvReader(path).read(); }

}  // namespace quadloop::io
