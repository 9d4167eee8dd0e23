#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "flow/command/solver_command.hpp"
#include "mesher/base/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace quadloop::test {

/// A cycle's folder. *Collective.*
class CycleFolder : public TemporaryFolder {
 public:
  /// mesh.mesh and solution.mesh in the folder, which is the case's too; cycle 4, 6 ranks.
  flow::SolverFiles files() const;
  /// A command that runs a shell script of these lines with the solution as its $1. *Collective.*
  flow::SolverCommand script(const std::string& lines) const;
};

/// The Error that `call` throws.
struct Refusal {
  ExitStatus status = ExitStatus::done;
  std::string message;
};
Refusal refusal_of(const std::function<void()>& call);

/// True if `text` holds `part`.
bool holds(const std::string& text, const std::string& part);

/// The number that a script has written, as a whole line, to a file; 0 where it has not within ten seconds.
pid_t written_process(const std::string& path);
/// True once there is no such process, or only its status is left; false after ten seconds.
bool vanishes(pid_t process);

/// Lines that leave processes of three kinds, all deaf to SIGTERM: a child, one with a session of its own,
/// and an orphan with one. Their numbers go to files of the names in `stubborn_processes`.
extern const std::string start_stubborn_processes;
extern const std::vector<std::string> stubborn_processes;

}  // namespace quadloop::test
