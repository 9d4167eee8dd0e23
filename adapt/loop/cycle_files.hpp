#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapt/loop/cycle_folders.hpp"
#include "adapt/loop/loop.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// Which files a cycle is to have, and what its record keeps of the case.
struct CycleFileOptions {
  std::vector<std::string> formats;         ///< names of those that its mesh is written in
  std::vector<std::string> read_by_solver;  ///< names of further mesh files that are written, for warnings
  double gamma = 1.4;                       ///< ratio of specific heats, where a format wants it
  std::vector<std::string> fields;          ///< of quantity_names(), beside the solution
  /// Asked as each cycle begins, as files of the case may change meanwhile; its digests and settings alone
  /// count.
  std::function<CycleRecord()> of_case;
  std::int32_t partitions = 0;  ///< parts of the mesh, in those of the formats that hold them
  std::string outline = {};     ///< text of the file with it; empty: none is written
};

/// Writes what the loop does to the run's folder, a folder for each cycle, put in place when it is whole:
/// those of CyclePaths. The mesh in the program's own format is there, with the starting state, while the
/// solver runs, and so are its parts where they are wanted; these get the solution too in the end.
class CycleFiles final : public CycleObserver {
 public:
  using Told = std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)>;

  /// `told` hears of each cycle once its folder stands.
  CycleFiles(const Communicator& comm, CycleFolders& folders, CycleFileOptions options, Told told);

  void begin(int cycle) override;
  void meshed(const MeshResult& mesh, const Field& start) override;
  std::vector<std::string> solved(const Mesh& mesh, const SolvedFlow& flow) override;
  void planned(const CycleEnd& end) override;
  void finished(CycleRecord record, const std::vector<std::string>& notes,
                const std::vector<std::string>& warnings) override;
  std::string place_of_solution(int cycle) const override;

 private:
  std::vector<std::string> renames(const Mesh& mesh) const;
  void write_parts_of(const Mesh& mesh, const Field* field) const;

  const Communicator& comm_;
  CycleFolders& folders_;
  CycleFileOptions options_;
  CycleRecord of_case_;  ///< of the cycle under way
  Told told_;
  int cycle_ = 0;
  bool starts_afresh_ = true;
  CellParts cell_parts_;  ///< of the mesh under way
};

}  // namespace quadloop
