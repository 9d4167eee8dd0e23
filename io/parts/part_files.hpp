#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/parts/part_index.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::io {

/// Returns the formats, by suffix, in which partitions are written: those of `formats` that support it. CGNS
/// files of partitions have one zone, so they are excluded if there are several blocks.
std::vector<std::string> part_formats(const std::vector<std::string>& formats, std::size_t blocks = 1);

/// Returns the names of all files of a set.
std::vector<std::string> part_file_names(const std::string& prefix, std::int32_t parts,
                                         const std::vector<std::string>& formats);

/// The files of a partitioned mesh: each rank writes those of its parts, the root rank the common ones. The
/// bytes do not depend on the number of ranks.
class PartFiles {
 public:
  /// `comm` must outlive the object. Not collective.
  explicit PartFiles(const Communicator& comm) : comm_{comm}, alone_{MPI_COMM_SELF}, outputs_{alone_} {}

  /// Writes the files under temporary names. Of `index`, formats and blocks are used on every rank, the rest
  /// on the root only; formats must be from part_formats(). Throws OutputError on all ranks. *Collective.*
  void write(const std::string& prefix, const PartIndex& index, const std::vector<MeshPart>& parts);

  /// Renames the files, together with those of `whole`: after a signal either all have their names or none.
  /// If a rank's disk rejects a file, only the files of that rank are discarded. Throws OutputError on all
  /// ranks. *Collective.*
  void commit(OutputSet& whole);
  void commit();

 private:
  void write_part(const std::string& prefix, const PartIndex& index, const MeshPart& part);

  const Communicator& comm_;
  Communicator alone_;
  OutputSet outputs_;
};

/// Returns the index of a set on the root rank; on other ranks without the numbers of edges and the inner
/// lines. *Collective.*
PartIndex part_index(const Communicator& comm, const Mesh& mesh, std::int32_t parts,
                     const std::vector<std::string>& formats);

}  // namespace quadloop::io
