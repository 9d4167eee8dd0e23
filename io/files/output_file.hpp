#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/new_folder.hpp"
#include "io/files/staging_folder.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// An output on its way: written under `temporary` until the set it belongs to is committed. `temporary` is
/// known on rank 0 only.
struct StagedFile {
  std::string path;
  std::string temporary;
};

/// The outputs of one command: all of them appear whole, under their own names, or none does; of two runs
/// with the same names at the same time one has all its files stand. A link is followed: its target is
/// replaced. Rank 0 alone touches the disk, but for files that all ranks write; what fails there is the same
/// OutputError on every rank.
class OutputSet {
 public:
  /// `comm` must outlive the set. Not collective.
  explicit OutputSet(const Communicator& comm) : comm_{comm} {}
  /// Removes what was not committed.
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  const Communicator& communicator() const { return comm_; }

  /// Opens the temporary, empty, so that an output which cannot be written is refused before work goes into
  /// it. *Collective.*
  StagedFile stage(const std::string& path);

  /// The output that was staged last, for those who add to it once it is written. On rank 0 alone.
  const StagedFile& staged_last() const { return outputs_.back().staged; }

  /// An output that is a folder of these files: makes it where there is none, to be taken away again without
  /// a commit, and stages them in it. Refuses one that holds anything else: it would go with other files than
  /// these. *Collective.*
  std::vector<StagedFile> stage_folder(const std::string& path, const std::vector<std::string>& files);

  /// What this rank wrote to the descriptor, of the output `path`, comes to the disk before any file gets its
  /// name; until then other files are written. The set closes it. Not collective.
  void take_over(int descriptor, const std::string& path) { written_.push_back({descriptor, path}); }

  /// Brings all outputs to the disk, then gives them their names. *Collective.*
  void commit();

  /// The same of several sets, each of all ranks or of this one alone, as if they were one: a signal finds
  /// all files of all ranks under their names, or none. Each set's files appear all or not at all in any
  /// case. *Collective* over `comm`.
  static void commit_together(const Communicator& comm, std::initializer_list<OutputSet*> sets);

 private:
  struct Output {
    StagedFile staged;
    std::string target;  ///< where `staged.path` leads
  };

  /// Of a file that rank 0 staged.
  struct Written {
    int descriptor;
    std::string path;
  };

  void bring_to_disk();
  void bring_written_to_disk();
  void give_names();
  StagingFolder& staging_beside(const std::string& target, const std::string& shown);
  void put_in_place();

  const Communicator& comm_;
  std::vector<std::unique_ptr<Temporary>> folders_;  ///< made for outputs; the first four on rank 0 only
  std::vector<Output> outputs_;
  std::set<std::string> targets_;  ///< theirs
  std::map<FolderId, std::unique_ptr<StagingFolder>> staging_;
  std::vector<Written> written_;
};

/// Appends text to a staged file; on rank 0 only. Every failure, a full disk too, is an OutputError that
/// names the output.
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
