#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/base/communicator.hpp"

namespace quadloop {

/// An output on its way: written under `temporary`, which stands beside `path`, until the set it belongs to is committed.
struct StagedFile {
  std::string path;
  std::string temporary;
};

/// The outputs of one command: all of them appear whole, under their own names, or none does. Rank 0 alone touches the disk; what
/// fails there is the same OutputError on every rank.
class OutputSet {
 public:
  /// `comm` must outlive the set. Not collective.
  explicit OutputSet(const Communicator& comm) : comm_{comm} {}
  /// Removes what was not committed.
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  const Communicator& communicator() const { return comm_; }

  /// Opens the temporary, empty, so that an output which cannot be written is refused before work goes into it. *Collective.*
  StagedFile stage(const std::string& path);

  /// Brings all outputs to the disk, then gives them their names. *Collective.*
  void commit();

 private:
  const Communicator& comm_;
  std::vector<StagedFile> staged_;
};

/// Appends text to a staged file; on rank 0 only. Every failure, a full disk too, is an OutputError that names the output.
class OutputFile {
 public:
  explicit OutputFile(StagedFile staged);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// A disk may tell only now that it is full; the destructor closes as well, but can say nothing.
  void close();

 private:
  StagedFile staged_;
  int descriptor_ = -1;
};

}  // namespace quadloop
