#pragma once

// Inside io/cgns only.
#include <optional>
#include <string>
#include <unordered_map>

#include "io/cgns/cgns_handle.hpp"
#include "io/text/name_index.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The boundaries of all zones of a plane mesh by their names, and what the base's families say of them.
class CgnsBoundaries {
 public:
  using File = CgnsFile<InputError>;

  /// That of the mesh, which is added where there is none.
  BoundaryEdges& named(Mesh& mesh, const std::string& name, const std::string& condition);

  /// "none" for a family that says nothing. Throws InputError.
  std::string condition_of_family(const File& file, int base, const std::string& family);

 private:
  void read_families(const File& file, int base);

  NameIndex names_;
  /// To conditions, once they are asked for.
  std::optional<std::unordered_map<std::string, std::string>> families_;
};

}  // namespace quadloop
