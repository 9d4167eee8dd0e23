#include "io/su2/su2_dat_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/files/row_output.hpp"
#include "io/su2/su2_restart_table.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

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
  Su2DatReader(const Communicator& comm, const std::string& path) : comm_{comm} {
    loaded_.path = path;
    comm.together([&] { file_.emplace(path, comm.size() == 1); });
    require_same_size(comm, path, file_->size());
  }

  LoadedSolution read() {
    comm_.together([&] {
      read_head();
      read_names();
      read_rows();
    });
    return std::move(loaded_);
  }

 private:
  [[noreturn]] void refuse(const std::string& fault) const { throw InputError(loaded_.path + ": " + fault); }

  template <class Number>
  std::vector<Number> numbers_at(std::int64_t place, std::int64_t count) const {
    std::vector<Number> numbers(count);
    file_->read_at(place, std::as_writable_bytes(std::span(numbers)));
    if (turned_) std::ranges::transform(numbers, numbers.begin(), reversed<Number>);
    return numbers;
  }

  void read_head() {
    if (file_->size() < std::int64_t{sizeof(Head)}) refuse("is too short for a restart file of SU2");
    turned_ = numbers_at<std::int32_t>(0, 1)[0] == reversed(magic);
    const std::vector<std::int32_t> head = numbers_at<std::int32_t>(0, 3);
    if (head[0] != magic) refuse("is no binary restart file of SU2, which begins with the number 535532");
    const std::int32_t columns = head[1], nodes = head[2];
    if (columns < 1 || nodes < 1) refuse(fmt::format("promises {} variables at {} nodes", columns, nodes));
    columns_ = columns;
    loaded_.nodes = nodes;
    const std::size_t left = file_->size() - sizeof(Head);
    const std::size_t wanted_names = columns_ * name_bytes;
    if (left < wanted_names ||
        (left - wanted_names) / sizeof(double) / columns_ < static_cast<std::size_t>(nodes))
      refuse(fmt::format("promises {} variables at {} nodes, but has {} bytes only; it is cut short", columns,
                         nodes, file_->size()));
  }

  void read_names() {
    for (std::size_t column = 0; column < columns_; ++column) {
      std::string name(name_bytes, '\0');
      file_->read_at(static_cast<std::int64_t>(sizeof(Head) + column * name_bytes),
                     std::as_writable_bytes(std::span(name)));
      name.resize(name.find('\0') < name.size() ? name.find('\0') : name.size());
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

  /// Each rank reads its even share.
  void read_rows() {
    constexpr std::int64_t numbers_of_piece = std::int64_t{1} << 16;
    const EvenShare share(comm_, loaded_.nodes);
    const auto width = static_cast<std::int64_t>(columns_);
    const auto begin = static_cast<std::int64_t>(sizeof(Head) + columns_ * name_bytes);
    const std::int64_t rows_of_piece = std::max<std::int64_t>(1, numbers_of_piece / width);
    loaded_.solution.values.reserve(share.size() * variables_.size());
    for (std::int64_t first = share.begin; first < share.end; first += rows_of_piece) {
      const std::int64_t rows = std::min(rows_of_piece, share.end - first);
      const std::vector<double> values =
          numbers_at<double>(begin + first * width * std::int64_t{sizeof(double)}, rows * width);
      for (std::size_t row = 0; row < values.size(); row += columns_) {
        for (const std::size_t column : variables_) loaded_.solution.values.push_back(values[row + column]);
        if (x_ < columns_) loaded_.points.push_back({values[row + x_], values[row + y_]});
      }
    }
  }

  const Communicator& comm_;
  std::optional<PlacedInput> file_;
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

LoadedSolution read_su2_dat(const Communicator& comm, const std::string& path) {
  return Su2DatReader(comm, path).read();
}

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
