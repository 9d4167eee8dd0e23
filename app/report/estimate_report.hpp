#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/report/statistics.hpp"
#include "mesher/build/build_mesh.hpp"

namespace quadloop::app {

/// Estimated sizes of files of a mesh in bytes, as far as they are known.
class FileSizes {
 public:
  /// `variables`: of a solution at the nodes, in the formats that store one.
  FileSizes(const std::vector<std::string>& files, MeshType type, const MeshEstimate& estimate,
            int variables = 0);

  double sum() const { return sum_; }
  /// Adds a row for each file, and the member "file_bytes" of the record.
  void add_to(Statistics& statistics) const;

 private:
  std::vector<std::pair<std::string, double>> sizes_;
  double sum_ = 0;
};

/// Adds the estimated number of cells, the memory of one of `ranks` ranks and that of all.
void add_run_estimate(Statistics& statistics, const MeshEstimate& estimate, int ranks);

/// Adds the size of several files, as "12.3 MB".
void add_file_sum(Statistics& statistics, const std::string& name, double bytes, const std::string& key);

/// Returns the estimated number of nodes of a mesh.
double nodes_of(const MeshEstimate& estimate, MeshType type);

/// Returns the estimate of a mesh of this number of nodes, if that is larger, with cells distributed as here.
MeshEstimate grown_to(const MeshEstimate& estimate, MeshType type, double nodes);

}  // namespace quadloop::app
