#include <optional>
#include <utility>
#include <variant>

#include "io/cgns/cgns_contents.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_ranges.hpp"
#include "io/files/reading/relay.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/inner_curves.hpp"

namespace quadloop::io {

namespace {

/// Returns a mesh that is whole on this rank.
MeshOfFile cleaned_up(FileMesh mesh, const std::string& path) {
  require_consistent(mesh, path);
  if (mesh.dimension == 3) return mesh;
  LoadedMesh loaded = loaded_mesh_of(std::move(mesh));
  if (loaded.blocks > 1) keep_first_mentions(loaded);
  separate_inner_curves(loaded, EdgeTable(loaded.mesh), path);
  return loaded;
}

/// Reads the mesh on the root, or only what the root alone reads. Of a mesh by ranges all ranks get the
/// contents. Returns a mesh that is whole on the root otherwise. *Collective.*
std::optional<MeshOfFile> read_at_root(const Communicator& comm, const std::string& path,
                                       const std::vector<std::string>& options, CgnsContents& contents) {
  MeshOfFile whole;
  comm.together([&] {
    if (!comm.is_root()) return;
    contents = read_separately<CgnsContents>("cgns", path, options);
    if (!contents.by_ranges) whole = cleaned_up(std::exchange(contents.mesh, {}), path);
  });
  if (!comm.any(contents.by_ranges)) return whole;
  broadcast_value(comm, contents);
  return {};
}

/// Returns nothing, on all ranks, if one of them found an invalid number, or cannot read the
/// file. *Collective.*
std::optional<LoadedMesh> read_by_ranges(const Communicator& comm, const std::string& path,
                                         CgnsContents contents) {
  try {
    LoadedMesh loaded = read_cgns_ranges(comm, path, std::move(contents));
    separate_inner_curves(comm, loaded, path);
    return loaded;
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

MeshOfFile read_cgns(const Communicator& comm, const std::string& path) {
  CgnsContents contents;
  std::optional<MeshOfFile> whole = read_at_root(comm, path, {}, contents);
  if (!whole) {
    if (auto loaded = read_by_ranges(comm, path, std::move(contents))) return std::move(*loaded);
    // the root reads all to name the first error of the file
    whole = read_at_root(comm, path, {"whole"}, contents);
  }
  return distributed(comm, std::move(whole).value());
}

}  // namespace quadloop::io
