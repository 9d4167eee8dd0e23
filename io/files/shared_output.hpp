#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// A staged file into which all ranks write at once, each at places that it knows: nothing passes through
/// rank 0. The ranks' machines must share the folder. Every failure is an OutputError that names the output,
/// the same one on all ranks.
class SharedOutput {
 public:
  /// *Collective.*
  SharedOutput(const Communicator& comm, const StagedFile& staged);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;

  const Communicator& communicator() const { return comm_; }

  /// Not collective: call it within Communicator::together(). No two ranks write the same byte.
  void write_at(std::int64_t offset, std::string_view bytes);

  /// What this rank wrote is on the disk, before rank 0 gives the file its name. *Collective.*
  void close();

 private:
  SharedOutput(const Communicator& comm, std::string path);

  const Communicator& comm_;
  std::string path_;  ///< as messages name it
  int descriptor_ = -1;
};

}  // namespace quadloop
