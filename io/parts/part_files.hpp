#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/parts/part_index.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop {

/// What the parts of a mesh are written in, by suffix: those of `formats` that are written in parts. CGNS
/// files of parts have one zone: not where there are several blocks.
std::vector<std::string> part_formats(const std::vector<std::string>& formats, std::int32_t blocks = 1);

/// The names of all files of a set.
std::vector<std::string> part_file_names(const std::string& prefix, std::int32_t parts,
                                         const std::vector<std::string>& formats);

/// The files of a mesh in parts: each rank writes those of the parts that it holds, the root rank what is
/// one for all. The bytes do not depend on the number of ranks.
class PartFiles {
 public:
  /// `comm` must outlive it. Not collective.
  explicit PartFiles(const Communicator& comm) : comm_{comm}, alone_{MPI_COMM_SELF}, outputs_{alone_} {}

  /// Writes under temporary names. `index` counts on the root rank alone but for its formats and blocks;
  /// formats are of part_formats(). *Collective.* Throws OutputError on all ranks.
  void write(const std::string& prefix, const PartIndex& index, const std::vector<MeshPart>& parts);

  /// Gives the files their names, those of `whole` with them: a signal finds all of them or none. What a disk
  /// refuses of one rank's files takes back all of that rank's alone. *Collective.* Throws OutputError on all
  /// ranks.
  void commit(OutputSet& whole);
  void commit();

 private:
  void write_part(const std::string& prefix, const PartIndex& index, const MeshPart& part);

  const Communicator& comm_;
  Communicator alone_;
  OutputSet outputs_;
};

/// What the index of a set says, on the root rank; elsewhere without the numbers of edges. `blocks` are the
/// names of the whole's. *Collective.*
PartIndex part_index(const Communicator& comm, const Mesh& mesh, std::int32_t parts,
                     const std::vector<std::string>& formats, const std::vector<std::string>& blocks);

}  // namespace quadloop
