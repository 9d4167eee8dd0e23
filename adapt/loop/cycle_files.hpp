#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapt/loop/cycle_folders.hpp"
#include "adapt/loop/loop.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop::adapt {

/// The files of a cycle, and the case data in its record.
struct CycleFileOptions {
  std::vector<std::string> formats;         ///< names of the formats of its mesh
  std::vector<std::string> read_by_solver;  ///< names of further mesh files that are written, for warnings
  double gamma = 1.4;                       ///< ratio of specific heats, for formats that need it
  std::vector<std::string> fields;          ///< of quantity_names(), in addition to the solution
  /// Called as each cycle begins, as files of the case may change meanwhile; only its digests and settings
  /// are used.
  std::function<CycleRecord()> of_case;
  std::int32_t partitions = 0;  ///< parts of the mesh, in the formats that support them
  /// Returns the text of the geometry file, on the first rank; empty: none is written.
  std::function<std::string()> outline = {};
};

/// Writes the results of the loop to the run's folder: one folder per cycle, renamed into place when
/// complete, with the files of CyclePaths. While the solver runs it contains the mesh in the native format
/// with the initial state, and its partitions if requested; these receive the solution at the end.
class CycleFiles final : public CycleObserver {
 public:
  using Report = std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)>;

  /// `told` is called for each cycle once its folder is in place.
  CycleFiles(const Communicator& comm, CycleFolders& folders, CycleFileOptions options, Report told);

  void begin(int cycle) override;
  void meshed(const MeshResult& mesh, const Field& start) override;
  std::vector<std::string> solved(const Mesh& mesh, const flow::SolvedFlow& flow) override;
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
  CycleRecord of_case_;  ///< of the current cycle
  Report told_;
  int cycle_ = 0;
  bool starts_afresh_ = true;
  CellParts cell_parts_;  ///< of the current mesh
};

}  // namespace quadloop::adapt
