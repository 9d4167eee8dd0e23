#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// A staged file that all ranks write concurrently, each at known offsets, without rank 0. The machines of
/// the ranks must share the folder; otherwise rank 0 may write everything. Every failure is an OutputError
/// that names the output, the same on all ranks.
class SharedOutput {
 public:
  enum class Writers { all, root };

  /// *Collective.*
  SharedOutput(OutputSet& outputs, const StagedFile& staged, Writers writers = Writers::all);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;

  /// For writing ranks; not collective: call it within Communicator::together(). Ranks must not write the
  /// same byte.
  void write_at(std::int64_t offset, std::string_view bytes);

  /// Call after the last write. Write-back has started; the set, which `outputs` must be until then, waits
  /// for it on commit. *Collective.*
  void close();

 private:
  SharedOutput(OutputSet& outputs, std::string path);
  void begin_on_disk();

  OutputSet& outputs_;
  std::string path_;  ///< as shown in messages
  int descriptor_ = -1;
  std::int64_t waiting_ = 0;  ///< bytes of this rank for which write-back has not started
};

/// Whether all ranks can write the staged file, i.e. their machines share the folder. *Collective.*
bool reached_by_all(const Communicator& comm, const StagedFile& staged);

}  // namespace quadloop::io
