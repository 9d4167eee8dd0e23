#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/output_file.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// A staged file that all ranks write concurrently, each at known offsets, without rank 0. A rank that cannot
/// open it, because its machine does not have the folder, sends what it writes to rank 0. Every failure is an
/// OutputError that names the output, the same on all ranks.
class SharedOutput {
 public:
  /// `outputs` must outlive the object. *Collective.*
  SharedOutput(OutputSet& outputs, const StagedFile& staged);
  ~SharedOutput();
  SharedOutput(const SharedOutput&) = delete;
  SharedOutput& operator=(const SharedOutput&) = delete;

  const Communicator& communicator() const { return outputs_.communicator(); }

  /// Runs `action` on every rank; write_at() may be called in it. If it throws on some ranks, all ranks throw
  /// the error of the lowest of these. *Collective.*
  void together(const std::function<void()>& action);

  /// Not collective; only within together(). Ranks must not write the same byte.
  void write_at(std::int64_t offset, std::string_view bytes);

  /// Call after the last write. Write-back has started; the set waits for it on commit. *Collective.*
  void close();

 private:
  SharedOutput(OutputSet& outputs, std::string path);
  bool is_relayed() const { return descriptor_ < 0; }
  void write_here(std::int64_t offset, std::string_view bytes);
  void send(std::int64_t offset, std::string_view bytes) const;
  void write_of_others();
  void write_of(int rank);
  void begin_on_disk();

  OutputSet& outputs_;
  std::string path_;  ///< as shown in messages
  int descriptor_ = -1;
  std::vector<int> relayed_;  ///< the ranks that cannot open the file
  std::int64_t waiting_ = 0;  ///< bytes of this rank for which write-back has not started
};

}  // namespace quadloop::io
