#pragma once

#include <string>

#include "mesher/base/communicator.hpp"

namespace quadloop {

/// The folder of an adaptive run: DIR/cycle_00, cycle_01, ..., each put in place whole. Work goes on in DIR/cycle_K.part. Rank 0 alone touches the
/// disk; all but the plain names are *collective*, and what fails is the same error on every rank.
class CycleFolders {
 public:
  CycleFolders(const Communicator& comm, std::string folder);

  /// Makes the folder where there is none, and says how many whole cycles it holds, from cycle 0 on; what is left of one that is not whole goes.
  /// Throws InputError where it is not empty and the run is not to be resumed, OutputError where it cannot be made.
  int open(bool resume);

  std::string whole(int cycle) const;
  std::string under_way(int cycle) const { return whole(cycle) + ".part"; }

  /// An empty folder to work in, in the place of an earlier one.
  void begin(int cycle);
  /// Brings it to the disk and gives it its name.
  void finish(int cycle);

 private:
  const Communicator& comm_;
  std::string folder_;
};

}  // namespace quadloop
