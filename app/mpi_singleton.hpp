#pragma once

#include <vector>

namespace quadloop::app {

/// To be constructed around MPI_Init: in a process without a launcher Open MPI (4) would start a daemon for
/// spawning further processes and probe every network, which takes a third of a second. The user's own
/// settings are kept; those made here are removed by the destructor, so that an external solver does not
/// inherit them.
class MpiSingleton {
 public:
  MpiSingleton();
  ~MpiSingleton();
  MpiSingleton(const MpiSingleton&) = delete;
  MpiSingleton& operator=(const MpiSingleton&) = delete;

 private:
  std::vector<const char*> set_;
};

}  // namespace quadloop::app
