#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes the mesh as UGRID with the byte order `order` (.b8.ugrid: big-endian; .lb8.ugrid: little-endian),
/// and a .mapbc file with number, condition and name of each patch. Faces are counter-clockwise as seen from
/// outside. Several blocks are written as volume identifiers, numbers from 1, after the cells. The bytes are
/// the same on any number of ranks. Throws OutputError on all ranks, also if the mesh is too large for 4-byte
/// integers. *Collective.*
template <std::endian order>
void write_ugrid(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Return the patch file of a 3D mesh: "a.mapbc" for "a.b8.ugrid", and of a plane one, which FUN3D does not
/// read: "a.ugrid.mapbc" for "a.ugrid".
std::string mapbc_path(const std::string& path);
std::string plane_mapbc_path(const std::string& path);

/// A patch in a .mapbc file.
struct MapbcPatch {
  std::string name;
  int condition = 0;  ///< FUN3D's number
};

/// Returns the text of a .mapbc file: patches are numbered from 1, with the names of mapbc_names().
std::string mapbc_text(const std::vector<MapbcPatch>& patches);
/// Reads the patches of such a file by number; empty if there is no file. Throws InputError.
std::map<std::int32_t, MapbcPatch> read_mapbc(const std::string& path);

/// Returns the names of patches in a .mapbc file: letters, digits and "_-.+".
std::vector<std::string> mapbc_names(const std::vector<std::string>& names);

/// Return FUN3D's number for Boundary::condition, 0 if there is none; `axis` is the normal of the patch ('x',
/// 'y', 'z'), if known. And the inverse, for walls the viscous or inviscid one, "none" for any other number.
int mapbc_condition(BoundaryCondition condition, char axis = ' ');
BoundaryCondition condition_of_mapbc(int number);

/// Reads such a file on the calling rank only; patches without a .mapbc are "patch_1" and so on. Volume
/// identifiers become blocks (set_blocks()); other data after the mesh are ignored, with a warning. Throws
/// InputError.
template <std::endian order>
MeshOfFile read_ugrid(const std::string& path);

}  // namespace quadloop::io
