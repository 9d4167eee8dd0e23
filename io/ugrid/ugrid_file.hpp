#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes the mesh as UGRID, the bytes of its numbers in the order `order` (.b8.ugrid: most significant
/// first; .lb8.ugrid: least), and beside it a .mapbc with the number, condition and name of each patch. Faces
/// are counter-clockwise as seen from outside. The bytes are the same on any number of ranks. *Collective.*
/// Throws OutputError on all ranks, also where 4-byte integers cannot count the mesh.
template <std::endian order>
void write_ugrid(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// The file of patches that goes with a 3D mesh: "a.b8.ugrid" has "a.mapbc". A plane one, which FUN3D does
/// not read, has its own: "a.ugrid" has "a.ugrid.mapbc".
std::string mapbc_path(const std::string& path);
std::string plane_mapbc_path(const std::string& path);

/// A patch as a .mapbc has it.
struct MapbcPatch {
  std::string name;
  int condition = 0;  ///< FUN3D's number
};

/// The text of a .mapbc: the patches numbered from 1, their names as mapbc_names() has them.
std::string mapbc_text(const std::vector<MapbcPatch>& patches);
/// The patches of such a file by number; none where there is no file. Throws InputError.
std::map<std::int32_t, MapbcPatch> read_mapbc(const std::string& path);

/// The names of patches in a .mapbc: letters, digits and "_-.+".
std::vector<std::string> mapbc_names(const std::vector<std::string>& names);

/// The number of FUN3D's boundary condition for Boundary::condition, 0 where nothing is said; `axis` is that
/// to which the patch is normal ('x', 'y', 'z'), where it is known. And back, "none" for any other.
int mapbc_condition(BoundaryCondition condition, char axis = ' ');
BoundaryCondition condition_of_mapbc(int number);

/// Reads such a file on the calling rank alone; patches without a .mapbc are "patch_1" and so on. What
/// follows the mesh is passed over, with a warning. Throws InputError.
template <std::endian order>
MeshOfFile read_ugrid(const std::string& path);

}  // namespace quadloop
