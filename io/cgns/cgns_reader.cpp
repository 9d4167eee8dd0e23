#include <utility>

#include "io/cgns/cgns_file.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/serialize_mesh.hpp"

namespace quadloop::io {

MeshOfFile read_cgns(const std::string& path) {
  FileMesh mesh = read_separately<FileMesh>("cgns", path);
  require_consistent(mesh, path);
  if (mesh.dimension == 3) return mesh;
  LoadedMesh loaded = loaded_mesh_of(std::move(mesh));
  if (loaded.blocks > 1) keep_first_mentions(loaded);
  separate_inner_curves(loaded, EdgeTable(loaded.mesh), path);
  return loaded;
}

}  // namespace quadloop::io
