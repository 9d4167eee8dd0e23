#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// A staged file into which all ranks write at once, each at places that it knows: nothing passes through
/// rank 0. The ranks' machines must share the folder; where they do not, rank 0 may write all. Every failure
/// is an OutputError that names the output, the same one on all ranks.
class SharedOutput {
 public:
  enum class Writers { all, root };

  /// *Collective.*
  SharedOutput(OutputSet& outputs, const StagedFile& staged, Writers writers = Writers::all);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;

  /// By a writer; not collective: call it within Communicator::together(). No two ranks write the same byte.
  void write_at(std::int64_t offset, std::string_view bytes);

  /// No rank writes any more. The disk has begun with what there is; the set, which `outputs` must be until
  /// then, waits for it when it is committed. *Collective.*
  void close();

 private:
  SharedOutput(OutputSet& outputs, std::string path);
  void begin_on_disk();

  OutputSet& outputs_;
  std::string path_;  ///< as messages name it
  int descriptor_ = -1;
  std::int64_t waiting_ = 0;  ///< bytes of this rank that the disk was not told of
};

/// Whether all ranks could write the staged file: their machines share the folder. *Collective.*
bool reached_by_all(const Communicator& comm, const StagedFile& staged);

}  // namespace quadloop
