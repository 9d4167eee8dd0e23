#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/run_in_folder.hpp"
#include "quadloop/case/case_input.hpp"

namespace quadloop {

/// A case for the adaptive loop, with what its commands report.
struct AdaptiveInput {
  adapt::AdaptiveCase adaptive;
  std::optional<double> morph_to;   ///< Settings::morph_to
  std::vector<FileExtent> extents;  ///< of the geometry files
  std::string note;                 ///< for the log; may be empty
};

/// Who solves: the solver of the case, or a function of the caller, whose variables are not known here.
enum class SolvedBy { solver_of_case, caller };

/// Prepares a loaded case for the adaptive loop; `arguments` are those of load_case(). On the calling rank
/// only. Throws InputError if the case has no table [adapt], and for errors that would stop the loop after
/// the initial mesh: unknown variables, and files that a solver cannot read or write.
AdaptiveInput adaptive_input(CaseInput input, const CaseArguments& arguments,
                             SolvedBy by = SolvedBy::solver_of_case);

}  // namespace quadloop
