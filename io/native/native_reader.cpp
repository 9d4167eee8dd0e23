#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "io/files/reading/relay.hpp"
#include "io/model/file_part.hpp"
#include "io/native/native_file.hpp"
#include "io/native/native_layout.hpp"
#include "io/text/range_tokens.hpp"
#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

/// Reads the rows of a rank's lines, then distributes them evenly.
class NativeReader {
 public:
  NativeReader(const Communicator& comm, const std::string& path, std::size_t piece)
      : comm_{comm}, path_{path}, tokens_{comm, path, piece} {}

  LoadedMesh read() {
    find_layout();
    comm_.together([&] {
      read_rows();
      if (fault_) throw InputError(path_ + ":" + std::to_string(fault_->line) + ": " + fault_->message);
    });
    FilePart parts(comm_, path_, points());
    parts.set_blocks(layout_.block_names, rows_by_section(NativeArray::triangles),
                     rows_by_section(NativeArray::quads));
    parts.add_triangles(nodes(NativeArray::triangles, 3));
    parts.add_quads(nodes(NativeArray::quads, 4));
    for (const auto& [name, layers] : layout_.boundaries) parts.add_boundary(name, {}, layers);
    parts.set_edges(nodes(NativeArray::edges, 2), layout_.boundary_entries,
                    rows_by_section(NativeArray::edges));
    parts.add_comments(layout_.comments, layout_.nodes);
    return parts.finish(solution());
  }

 private:
  /// Every rank gets what is known of the layout up to the first error.
  void find_layout() {
    const bool is_last = comm_.rank() == comm_.size() - 1;
    std::exception_ptr failure;
    layout_ = relay<NativeLayoutReader>(comm_, [&](NativeLayoutReader& reader) {
                try {
                  fault_ = reader.read(tokens_, comm_.size(), is_last);
                } catch (...) {  // the other ranks wait for this one
                  failure = std::current_exception();
                  reader.stop();
                }
              }).layout();
    comm_.together([&] {
      if (failure) std::rethrow_exception(failure);
    });
  }

  bool is_of_nodes(NativeArray array) const {
    return array == NativeArray::triangles || array == NativeArray::quads || array == NativeArray::edges;
  }

  /// Reads this rank's numbers, up to an error. That in the layout may come after one in the rows.
  void read_rows() {
    make_room();
    for (const NativeSection& section : layout_.sections) {
      const auto [begin, end] = own_tokens(section);
      if (begin == end) continue;
      tokens_.go_to(begin);
      const bool sound =
          is_of_nodes(section.array) ? read_nodes(section, begin, end) : read_reals(section, begin, end);
      if (!sound) return;
    }
  }

  struct TokenRange {
    std::int64_t begin, end;
  };
  /// This rank's tokens of a section.
  TokenRange own_tokens(const NativeSection& section) const {
    const std::int64_t begin = std::max(section.first_token, tokens_.begin());
    return {begin, std::max(begin, std::min(section.end_token(), tokens_.end()))};
  }

  void make_room() {
    std::array<std::int64_t, native_arrays> counts{};
    for (const NativeSection& section : layout_.sections) {
      const auto [begin, end] = own_tokens(section);
      counts[static_cast<std::size_t>(section.array)] += end - begin;
    }
    for (std::size_t array = 0; array < native_arrays; ++array) {
      if (is_of_nodes(static_cast<NativeArray>(array)))
        nodes_[array].reserve(counts[array]);
      else
        reals_[array].reserve(counts[array]);
    }
  }

  bool read_nodes(const NativeSection& section, std::int64_t begin, std::int64_t end) {
    std::vector<GlobalNodeId>& numbers = nodes_[static_cast<std::size_t>(section.array)];
    for (std::int64_t i = begin; i < end; ++i) {
      const std::string_view token = tokens_.next();
      std::int64_t node = 0;
      if (!parse_integer(token, node))
        return refuse(why_no_integer(token, expected_in(layout_, section, i - section.first_token)));
      if (node < 1 || node > layout_.nodes)
        return refuse("node " + std::to_string(node) + " is none of the nodes 1 to " +
                      std::to_string(layout_.nodes));
      numbers.push_back(GlobalNodeId{node - 1});
    }
    return true;
  }

  bool read_reals(const NativeSection& section, std::int64_t begin, std::int64_t end) {
    std::vector<double>& values = reals_[static_cast<std::size_t>(section.array)];
    for (std::int64_t i = begin; i < end; ++i) {
      const std::string_view token = tokens_.next();
      double value = 0;
      if (!parse_real(token, value) || !std::isfinite(value)) {
        const std::int64_t number = i - section.first_token;
        return refuse(why_no_finite_real(token, expected_in(layout_, section, number)) +
                      place_of_value(layout_, section, number));
      }
      values.push_back(value);
    }
    return true;
  }

  /// Notes an error at the last token, unless there is one before it. Returns false.
  bool refuse(const std::string& message) {
    const std::int64_t place = tokens_.place();
    if (!fault_ || place < fault_->place) fault_ = TextFault{place, tokens_.line_of(place), message};
    return false;
  }

  /// Returns the nodes of this rank's share of an array. *Collective.*
  std::vector<GlobalNodeId> nodes(NativeArray array, std::int64_t width) {
    return in_even_shares(comm_, std::exchange(nodes_[static_cast<std::size_t>(array)], {}), width);
  }

  std::vector<double> reals(NativeArray array, std::size_t width) {
    return in_even_shares(comm_, std::exchange(reals_[static_cast<std::size_t>(array)], {}),
                          static_cast<std::int64_t>(width));
  }

  /// Returns the rows of this rank's triangles, then those of its quads. *Collective.*
  std::vector<double> cell_values(std::size_t width) {
    std::vector<double>& own = reals_[static_cast<std::size_t>(NativeArray::cell_values)];
    const std::int64_t of_triangles =
                           layout_.rows_of(NativeArray::triangles) * static_cast<std::int64_t>(width),
                       before = comm_.exclusive_sum(std::ssize(own)),
                       middle = std::clamp<std::int64_t>(of_triangles - before, 0, std::ssize(own));
    std::vector<double> of_quads(own.begin() + middle, own.end());
    own.resize(middle);
    const auto share = [&](std::vector<double> rows) {
      return in_even_shares(comm_, std::move(rows), static_cast<std::int64_t>(width));
    };
    std::vector<double> values = share(std::move(own));
    of_quads = share(std::move(of_quads));
    values.insert(values.end(), of_quads.begin(), of_quads.end());
    return values;
  }

  std::vector<Point> points() {
    const std::vector<double> coordinates = reals(NativeArray::points, 2);
    std::vector<Point> points(coordinates.size() / 2);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {coordinates[2 * i], coordinates[2 * i + 1]};
    return points;
  }

  /// Returns the numbers of rows of the array's sections.
  std::vector<std::int64_t> rows_by_section(NativeArray array) const {
    std::vector<std::int64_t> rows;
    for (const NativeSection& section : layout_.sections) {
      if (section.array == array) rows.push_back(section.rows);
    }
    return rows;
  }

  /// Returns the solution, if there is one; a file without variables may have constants. *Collective.*
  std::optional<Field> solution() {
    Field solution;
    if (layout_.constants)
      solution.constants = comm_.all_gather_values(
          std::span<const double>(reals_[static_cast<std::size_t>(NativeArray::constants)]));
    if (layout_.variables) {
      solution.names = *layout_.variables;
      solution.values = reals(NativeArray::values, solution.names.size());
    }
    if (layout_.cell_variables) {
      solution.cells.names = *layout_.cell_variables;
      solution.cells.values = cell_values(solution.cells.names.size());
    }
    const bool none = solution.names.empty() && solution.cells.names.empty() && solution.constants.empty();
    return none ? std::nullopt : std::optional(std::move(solution));
  }

  const Communicator& comm_;
  const std::string& path_;
  RangeTokens tokens_;
  NativeLayout layout_;
  std::optional<TextFault> fault_;
  std::array<std::vector<double>, native_arrays> reals_;
  std::array<std::vector<GlobalNodeId>, native_arrays> nodes_;
};

}  // namespace

LoadedMesh read_native(const Communicator& comm, const std::string& path, std::size_t piece) {
  return NativeReader(comm, path, piece).read();
}

}  // namespace quadloop::io
