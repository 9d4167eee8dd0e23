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

namespace quadloop::io {

/// An output file written as `temporary` until its set is committed. `temporary` is known on rank 0 only.
struct StagedFile {
  std::string path;
  std::string temporary;
};

/// The outputs of one command: all of them appear completely, under their own names, or none does; if two
/// runs write the same names at the same time, all files are those of one of them. Links are followed: the
/// target is replaced. Only rank 0 accesses the disk, except for files that all ranks write; an error there
/// is the same OutputError on every rank.
class OutputSet {
 public:
  /// `comm` must outlive the set. Not collective.
  explicit OutputSet(const Communicator& comm) : comm_{comm} {}
  /// Removes what was not committed.
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  const Communicator& communicator() const { return comm_; }

  /// Creates the temporary file, empty, so that an output that cannot be written is rejected before any work.
  /// *Collective.*
  StagedFile stage(const std::string& path);

  /// The last staged output, for appending to it. On rank 0 only.
  const StagedFile& staged_last() const { return outputs_.back().staged; }

  /// Stages an output folder with these files. Creates the folder if necessary; it is removed again without a
  /// commit. Throws OutputError if it contains anything else, which would be mixed with these files.
  /// *Collective.*
  std::vector<StagedFile> stage_folder(const std::string& path, const std::vector<std::string>& files);

  /// Transfers a descriptor of the output `path` to the set, which closes it. Its data are flushed to disk
  /// before any file is renamed; meanwhile other files can be written. Not collective.
  void take_over(int descriptor, const std::string& path) { written_.push_back({descriptor, path}); }

  /// Flushes all outputs to disk, then renames them. *Collective.*
  void commit();

  /// Commits several sets, each of all ranks or of this one only, as one: after a signal either all files of
  /// all ranks have their names, or none. The files of each set appear all or not at all in any case.
  /// *Collective* over `comm`.
  static void commit_together(const Communicator& comm, std::initializer_list<OutputSet*> sets);

 private:
  struct Output {
    StagedFile staged;
    std::string target;  ///< target of `staged.path`
  };

  /// Data written to a file that rank 0 staged.
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
  std::vector<std::unique_ptr<Temporary>> folders_;  ///< created for outputs; the first four on rank 0 only
  std::vector<Output> outputs_;
  std::set<std::string> targets_;  ///< of outputs_
  std::map<FolderId, std::unique_ptr<StagingFolder>> staging_;
  std::vector<Written> written_;
};

/// Appends text to a staged file; on rank 0 only. Every failure, including a full disk, is an OutputError
/// that names the output.
class OutputFile {
 public:
  explicit OutputFile(StagedFile staged);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// A full disk may be detected only here; the destructor closes too, but cannot report it.
  void close();

 private:
  StagedFile staged_;
  int descriptor_ = -1;
};

}  // namespace quadloop::io
