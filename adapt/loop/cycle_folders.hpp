#pragma once

#include <string>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::adapt {

/// The folder of an adaptive run: DIR/cycle_00, cycle_01, ..., each renamed into place when complete. The
/// current cycle is written to DIR/cycle_K.part. Only rank 0 accesses the disk. All functions except the
/// names are *collective*; an error is raised on every rank.
class CycleFolders {
 public:
  CycleFolders(const Communicator& comm, std::string folder);
  ~CycleFolders();
  CycleFolders(const CycleFolders&) = delete;
  CycleFolders& operator=(const CycleFolders&) = delete;

  /// Creates the folder if necessary and returns the number of complete cycles, from cycle 0 on; incomplete
  /// ones are removed. Until this object is destroyed, or the process ends, no other run may use the folder;
  /// the lock leaves no file. Throws InputError if the folder holds more than an incomplete first cycle and
  /// the run is not resumed, if another run uses it, or if a cycle is missing before a later one; OutputError
  /// if it cannot be created. `start`, one line that begins with a digest, identifies the initial mesh of
  /// cycle 0; empty: the case's own. As long as no cycle is complete, resuming with another digest is an
  /// InputError.
  int open(bool resume, const std::string& start = {});

  const std::string& folder() const { return folder_; }
  std::string whole(int cycle) const;
  std::string under_way(int cycle) const { return whole(cycle) + ".part"; }

  /// Creates an empty folder for the cycle, replacing an earlier one.
  void begin(int cycle);
  /// Removes the folder of the cycle under way. On the root; no error is reported. Not collective.
  void discard(int cycle);
  /// Flushes the folder to disk and renames it.
  void finish(int cycle);

 private:
  void lock();
  int count_whole() const;
  std::string start_file() const;
  void settle_start(bool resume, const std::string& start) const;

  const Communicator& comm_;
  std::string folder_;
  int lock_ = -1;  ///< file descriptor, on the root
};

}  // namespace quadloop::adapt
