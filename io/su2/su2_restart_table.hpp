#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace quadloop::io {

/// The columns of SU2's restart files after the coordinates: first its four conservative variables, if the
/// solution has them or density, velocity and pressure from which they follow, then all other variables
/// unchanged. A solution of SU2's incompressible solvers, which begins with Pressure, Velocity_x, Velocity_y,
/// is unchanged.
class Su2RestartTable {
 public:
  /// `gamma` is the ratio of specific heats.
  Su2RestartTable(std::span<const std::string> variables, double gamma);

  /// Each name is read back as a variable: no comma or quote, no number, no coordinate, no duplicates.
  const std::vector<std::string>& names() const { return names_; }

  /// Calls `put(value)` for each column, from a row of the solution.
  template <class Put>
  void for_each_value(std::span<const double> row, const Put& put) const {
    if (made_from_) {
      for (const double value : conserved(row)) put(value);
    }
    for (const std::size_t column : as_they_are_) put(row[column]);
  }

 private:
  using Columns = std::array<std::size_t, 4>;

  static std::optional<Columns> columns_of(std::span<const std::string> names,
                                           const std::array<const char*, 4>& wanted);
  std::string distinct(std::string name) const;
  std::array<double, 4> conserved(std::span<const double> row) const;

  double gamma_;
  std::optional<Columns> made_from_;  ///< if the first four columns are computed: from these
  std::vector<std::size_t> as_they_are_;
  std::vector<std::string> names_;
};

}  // namespace quadloop::io
