#pragma once

#include <vector>

namespace quadloop {

/// Around MPI_Init: in a process that no launcher started Open MPI (4) would start a daemon beside it, with
/// which it could spawn others, and try every network: a third of a second that nobody needs. Settings that
/// the user has made stand; those made here are gone with this, so that a solver does not inherit them.
class LoneProcess {
 public:
  LoneProcess();
  ~LoneProcess();
  LoneProcess(const LoneProcess&) = delete;
  LoneProcess& operator=(const LoneProcess&) = delete;

 private:
  std::vector<const char*> set_;
};

}  // namespace quadloop
