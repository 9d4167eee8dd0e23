#pragma once

#include <string>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// The folder of an adaptive run: DIR/cycle_00, cycle_01, ..., each put in place whole. Work goes on in
/// DIR/cycle_K.part. Rank 0 alone touches the disk; all but the plain names are *collective*, and what fails
/// is the same error on every rank.
class CycleFolders {
 public:
  CycleFolders(const Communicator& comm, std::string folder);
  ~CycleFolders();
  CycleFolders(const CycleFolders&) = delete;
  CycleFolders& operator=(const CycleFolders&) = delete;

  /// Makes the folder where there is none, and says how many whole cycles it holds, from cycle 0 on; what is
  /// left of one that is not whole goes. From here to the end of this object, or of the process, no other run
  /// may work there; the lock leaves no file. Throws InputError where the folder holds more than a first
  /// cycle that is not whole and the run is not to be resumed, where another run is at work in it, or where a
  /// cycle is missing before a later one; OutputError where it cannot be made.
  /// `start`, one line that begins with a digest, is what cycle 0 begins with; empty: with a mesh of its own.
  /// As long as no cycle is whole a run is resumed with the same digest alone: else an InputError.
  int open(bool resume, const std::string& start = {});

  const std::string& folder() const { return folder_; }
  std::string whole(int cycle) const;
  std::string under_way(int cycle) const { return whole(cycle) + ".part"; }

  /// An empty folder to work in, in the place of an earlier one.
  void begin(int cycle);
  /// Brings it to the disk and gives it its name.
  void finish(int cycle);

 private:
  void lock();
  int count_whole() const;
  std::string start_file() const;
  void settle_start(bool resume, const std::string& start) const;

  const Communicator& comm_;
  std::string folder_;
  int lock_ = -1;  ///< a descriptor, on the root
};

}  // namespace quadloop
