#pragma once

#include <optional>
#include <string>

namespace quadloop {

/// What SU2's history tells of a run's end, where its columns do.
struct Su2End {
  std::optional<double> cl, cd;    ///< columns CL and CD
  std::optional<double> residual;  ///< that of the density (or, without one, of the pressure) over the first
};

/// From the text of history.csv: a row of names, often in double quotes, then a row for each iteration;
/// residuals are logarithms to the base of ten. What cannot be read is left out.
Su2End end_of_history(const std::string& text);

}  // namespace quadloop
