#include "io/files/reading/file_kind.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

constexpr const char* save_as = "save the mesh as .vtu, .msh (Gmsh), .su2 or .cgns";
constexpr const char* is_geometry = "it contains a geometry; a mesh is required here";

/// A kind of file identified by its beginning, after blanks, or by a text within its first bytes.
struct Signature {
  std::string_view begins, contains;
  const char* what;
  std::vector<std::string> suffixes = {};
  const char* cure = save_as;
};

const std::vector<Signature>& signatures() {
  using namespace std::string_view_literals;
  static const std::vector<Signature> all{
      {"# vtk DataFile",
       "",
       "a VTK file in the legacy format",
       {},
       "save it as an unstructured grid in XML (.vtu)"},
      {"<?xml", "<VTKFile", "a VTK file in XML", {".vtu", ".pvtu"}},
      {"<VTKFile", "", "a VTK file in XML", {".vtu", ".pvtu"}},
      {"<?xml", "<Xdmf", "an XDMF file"},
      {"<?xml", "<dolfin", "a DOLFIN file in XML"},
      {"$MeshFormat", "", "a mesh of Gmsh", {".msh", ".msh41"}},
      {"$NOD", "", "a mesh of Gmsh, version 1", {}, "save it from Gmsh in version 2.2 or 4.1"},
      {"MeshVersionFormatted", "", "a mesh in Medit's format", {".mesh", ".medit"}},
      {"\1\0\0\0\2\0\0\0"sv, "", "a binary mesh in Medit's format (.meshb)", {}, "save it as text (.mesh)"},
      {"quadloop binary mesh", "", "a binary mesh of quadloop", {".qmesh"}},
      {"CDF\1"sv, "", "a NetCDF file, such as Exodus II"},
      {"CDF\2"sv, "", "a NetCDF file, such as Exodus II"},
      {"ADF Database Version", "", "a CGNS file in the old ADF format", {}, "convert it by adf2hdf"},
      {"\x1f\x8b"sv, "", "a file compressed by gzip", {}, "unpack it first"},
      {"PK\3\4"sv, "", "a ZIP archive", {}, "unpack it first"},
      {"ISO-10303-21", "", "a STEP file", {}, is_geometry},
      {"DBRep_DrawableShape", "", "a BREP file of OpenCASCADE", {}, is_geometry},
      {"CASCADE Topology", "", "a BREP file of OpenCASCADE", {}, is_geometry},
      {"solid", "facet normal", "an STL surface", {}, is_geometry},
      {"OFF\n", "", "an OFF surface", {}, is_geometry},
      {"ply\n", "", "a PLY surface", {}, is_geometry},
      {"#!TDV", "", "a binary Tecplot file"},
      {"TITLE", "VARIABLES", "a Tecplot file"},
      {"VARIABLES", "ZONE", "a Tecplot file"},
      {"*HEADING", "", "an Abaqus file"},
      {"*NODE", "", "an Abaqus file"},
      {"", "BEGIN BULK", "a Nastran file"},
      {"CEND", "", "a Nastran file"},
      {"GRID", "", "a Nastran file"},
      {"$", "\nGRID", "a Nastran file"},
      {"-1\n", "", "a universal file of I-deas (.unv)"},
      {"-1\r\n", "", "a universal file of I-deas (.unv)"},
      {"CONTROL INFO", "GAMBIT", "a neutral file of Gambit"},
      {"mesh3d", "", "a mesh of Netgen"},
      {"MFEM mesh", "", "a mesh of MFEM"},
      {"FoamFile", "", "a file of OpenFOAM", {}, "give its folder polyMesh"},
      {"NDIME=", "", "a mesh of SU2", {".su2"}},
      {"(0 ", "", "a mesh of Fluent", {".msh"}},
      {"NZONE=", "", "a mesh of SU2", {".su2"}},
  };
  return all;
}

std::string first_bytes(const std::string& path) {
  std::array<char, 4096> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

std::string_view without_blanks_before(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // UTF-8 byte order mark
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// A header of 80 bytes, the number of triangles, 50 bytes for each.
bool is_binary_stl(std::string_view begins, std::uintmax_t size) {
  if (begins.size() < 84) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, begins.data() + 80, sizeof triangles);
  return triangles > 0 && size == 84 + std::uintmax_t{50} * triangles;
}

/// Nodes of Triangle or TetGen: their number, 2 or 3 dimensions, numbers of attributes and of markers; then
/// rows with consecutive numbers from 0 or 1, at least one. Lines may be comments.
bool is_node_file(std::string_view text) {
  std::istringstream rows{std::string(text)};
  std::string row;
  const auto next_numbers = [&] {
    std::vector<double> numbers;
    while (numbers.empty() && std::getline(rows, row)) {
      std::istringstream words(row.substr(0, row.find('#')));
      for (double number; words >> number;) numbers.push_back(number);
    }
    return numbers;
  };
  const std::vector<double> head = next_numbers();
  if (head.size() != 4 || (head[1] != 2 && head[1] != 3)) return false;
  const std::vector<double> one = next_numbers(), two = next_numbers();
  const bool is_first =
      static_cast<double>(one.size()) == 1 + head[1] + head[2] + head[3] && (one[0] == 0 || one[0] == 1);
  return is_first && (two.empty() || (one.size() == two.size() && two[0] == one[0] + 1));
}

/// HDF5 is the container of many formats; the names of groups or the suffix determine which.
FileKind hdf5_kind(const std::string& path, std::string_view begins) {
  const std::string name = small_letters(path);
  if (name.ends_with(".cas.h5") || name.ends_with(".msh.h5"))
    return {"a mesh of Fluent in HDF5", {}, "save it in Fluent as a legacy ASCII file"};
  const bool has_med_groups = begins.find("ENS_MAA") != std::string_view::npos ||
                              begins.find("INFOS_GENERALES") != std::string_view::npos;
  if (has_med_groups || name.ends_with(".med")) return {"a mesh of Salome (MED)", {}, save_as};
  if (begins.find("VTKHDF") != std::string_view::npos || name.ends_with(".vtkhdf"))
    return {"a VTKHDF file, which is written but not read",
            {},
            "give the mesh as .mesh, .cgns or .vtu; save one of another program as .vtu"};
  return {"an HDF5 file", {".cgns", ".h5"}, save_as};
}

}  // namespace

std::optional<FileKind> kind_of_file(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) return std::nullopt;
  const std::string bytes = first_bytes(path);
  if (bytes.starts_with("\x89HDF")) return hdf5_kind(path, bytes);
  const std::string_view text = without_blanks_before(bytes);
  for (const Signature& signature : signatures()) {
    const bool fits = text.starts_with(signature.begins) &&
                      (signature.contains.empty() || text.find(signature.contains) != std::string_view::npos);
    if (fits) return FileKind{signature.what, signature.suffixes, signature.cure};
  }
  if (is_binary_stl(bytes, std::filesystem::file_size(path, failure)))
    return FileKind{"a binary STL surface", {}, is_geometry};
  if (is_node_file(text)) return FileKind{"a file of nodes of Triangle or TetGen (.node)", {}, save_as};
  return std::nullopt;
}

}  // namespace quadloop::io
