#include "io/su2/su2_dat_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/files/row_output.hpp"
#include "io/su2/su2_restart_table.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr std::int32_t magic = 535532;
constexpr std::size_t name_bytes = 33;
using Head = std::array<std::int32_t, 5>;

template <class Number>
Number reversed(Number value) {
  constexpr auto other = std::endian::native == std::endian::little ? std::endian::big : std::endian::little;
  return in_order<other>(value);
}

class Su2DatReader {
 public:
  explicit Su2DatReader(const std::string& path) : bytes_{read_input(path)} { loaded_.path = path; }

  LoadedSolution read() {
    read_head();
    read_names();
    read_rows();
    return std::move(loaded_);
  }

 private:
  [[noreturn]] void refuse(const std::string& fault) const { throw InputError(loaded_.path + ": " + fault); }

  template <class Number>
  Number number_at(std::size_t byte) const {
    Number value{};
    std::memcpy(&value, bytes_.data() + byte, sizeof value);
    return turned_ ? reversed(value) : value;
  }

  void read_head() {
    if (bytes_.size() < sizeof(Head)) refuse("is too short for a restart file of SU2");
    turned_ = number_at<std::int32_t>(0) == reversed(magic);
    if (number_at<std::int32_t>(0) != magic)
      refuse("is no binary restart file of SU2, which begins with the number 535532");
    const auto columns = number_at<std::int32_t>(sizeof magic),
               nodes = number_at<std::int32_t>(2 * sizeof magic);
    if (columns < 1 || nodes < 1) refuse(fmt::format("promises {} variables at {} nodes", columns, nodes));
    columns_ = columns;
    loaded_.nodes = nodes;
    const std::size_t left = bytes_.size() - sizeof(Head);
    const std::size_t wanted_names = columns_ * name_bytes;
    if (left < wanted_names ||
        (left - wanted_names) / sizeof(double) / columns_ < static_cast<std::size_t>(nodes))
      refuse(fmt::format("promises {} variables at {} nodes, but has {} bytes only; it is cut short", columns,
                         nodes, bytes_.size()));
  }

  void read_names() {
    for (std::size_t column = 0; column < columns_; ++column) {
      const char* const text = bytes_.data() + sizeof(Head) + column * name_bytes;
      const std::string name(text, std::find(text, text + name_bytes, '\0'));
      if (name == "x") x_ = column;
      if (name == "y") y_ = column;
      if (name == "x" || name == "y") continue;
      if (name == "z") refuse("is of a mesh in three dimensions: it has a variable z");
      variables_.push_back(column);
      loaded_.solution.names.push_back(name);
    }
    if (variables_.empty()) refuse("has no variables beside coordinates");
    if ((x_ < columns_) != (y_ < columns_)) refuse("has only one of the coordinates x and y");
  }

  void read_rows() {
    const std::size_t begin = sizeof(Head) + columns_ * name_bytes;
    const auto value = [&](std::size_t row, std::size_t column) {
      return number_at<double>(begin + (row * columns_ + column) * sizeof(double));
    };
    const auto rows = static_cast<std::size_t>(loaded_.nodes);
    loaded_.solution.values.reserve(rows * variables_.size());
    for (std::size_t row = 0; row < rows; ++row) {
      for (const std::size_t column : variables_) loaded_.solution.values.push_back(value(row, column));
      if (x_ < columns_) loaded_.points.push_back({value(row, x_), value(row, y_)});
    }
  }

  std::string bytes_;
  bool turned_ = false;  ///< the file has the other byte order
  std::size_t columns_ = 0;
  std::size_t x_ = std::numeric_limits<std::size_t>::max(), y_ = x_;
  std::vector<std::size_t> variables_;  ///< their columns
  LoadedSolution loaded_;
};

std::string head_of(const std::vector<std::string>& names, std::int64_t nodes) {
  const Head head{magic, static_cast<std::int32_t>(names.size() + 2), static_cast<std::int32_t>(nodes), 0, 0};
  std::string text(bytes_of(std::span(head)));
  for (std::string name : {std::string("x"), std::string("y")}) text += (name.resize(name_bytes), name);
  for (std::string name : names) {
    name.resize(std::min(name.size(), name_bytes - 1));
    name.resize(name_bytes);
    text += name;
  }
  return text;
}

}  // namespace

LoadedSolution read_su2_dat(const std::string& path) { return Su2DatReader(path).read(); }

void write_su2_dat(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma) {
  constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;
  const Communicator& comm = outputs.communicator();
  const Su2RestartTable table(solution.names, gamma);
  const std::int64_t nodes = comm.sum(mesh.owned_nodes);
  if (nodes > std::numeric_limits<std::int32_t>::max())
    throw OutputError(
        path + ": " + std::to_string(nodes) +
        " nodes are more than this format can count (32-bit numbers); write a .csv file instead");
  RowOutput file(outputs, outputs.stage(path));
  file.write(head_of(table.names(), nodes));
  const auto width = static_cast<std::int64_t>(table.names().size()) + 2;
  std::vector<double> rows;
  file.write_sections({{mesh.owned_nodes},
                       width * std::int64_t{sizeof(double)},
                       std::max<std::int64_t>(1, numbers_per_piece / width)},
                      [&](std::size_t, std::int64_t begin, std::int64_t end) {
                        rows.clear();
                        for (std::int64_t i = begin; i < end; ++i) {
                          rows.push_back(mesh.points[i].x);
                          rows.push_back(mesh.points[i].y);
                          table.for_each_value(
                              std::span(solution.values).subspan(i * solution.width(), solution.width()),
                              [&](double value) { rows.push_back(value); });
                        }
                        return bytes_of(std::span<const double>(rows));
                      });
  file.close();
}

}  // namespace quadloop::io
