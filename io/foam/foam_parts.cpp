#include "io/foam/foam_parts.hpp"

#include "io/foam/foam_file.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop {

std::vector<std::string> foam_files(const StreamBlocks& blocks) {
  std::vector<std::string> files{"points", "faces", "owner", "neighbour", "boundary"};
  if (blocks.several()) files.emplace_back("cellZones");
  return files;
}

std::string foam_head(const std::string& type, const std::string& object, const std::string& note) {
  std::string head =
      "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + type + ";\n";
  if (!note.empty()) head += "    note        \"" + note + "\";\n";
  return head + "    location    \"constant/polyMesh\";\n    object      " + object + ";\n}\n\n";
}

std::string foam_counts_note(const StreamCounts& counts, std::int64_t faces, std::int64_t internal_faces) {
  return "nPoints:" + std::to_string(counts.nodes) + "  nCells:" + std::to_string(counts.cells()) +
         "  nFaces:" + std::to_string(faces) + "  nInternalFaces:" + std::to_string(internal_faces);
}

std::string foam_patch_type(const std::string& condition) {
  if (is_wall(condition)) return "wall";
  return condition == "symmetry" ? condition : "patch";
}

void write_foam_boundary(const Communicator& comm, const StagedFile& staged,
                         const std::vector<StreamedPatch>& patches, const std::vector<std::string>& types,
                         std::int64_t internal_faces) {
  std::vector<std::string> names;
  for (const StreamedPatch& patch : patches) names.push_back(patch.name);
  names = foam_patch_names(names);
  std::string text = foam_head("polyBoundaryMesh", "boundary") + std::to_string(names.size()) + "\n(\n";
  std::int64_t start = internal_faces;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const std::int64_t faces = patches[n].faces();
    text += "    " + names[n] + "\n    {\n        type            " + types[n] +
            ";\n        nFaces          " + std::to_string(faces) + ";\n        startFace       " +
            std::to_string(start) + ";\n    }\n";
    start += faces;
  }
  TextOutput file(comm, staged);
  file.write(text + ")\n");
  file.close();
}

void write_foam_points(const MeshStream& stream, const StagedFile& staged) {
  TextOutput file(stream.communicator(), staged);
  file.write(foam_head("vectorField", "points") + std::to_string(stream.counts().nodes) + "\n(\n");
  file.write_rows(stream.point_rows(), 4, [&](TextRows& text, std::int64_t i) {
    const Point3 p = stream.point(i);
    text.mark('(');
    text.put(p.x, ' ');
    text.put(p.y, ' ');
    text.put(p.z, ')');
    text.mark('\n');
  });
  file.write(")\n");
  file.close();
}

void write_foam_zones(const MeshStream& stream, const StreamBlocks& blocks, const StagedFile& staged) {
  const Communicator& comm = stream.communicator();
  TextOutput file(comm, staged);
  const std::vector<std::string> names = foam_patch_names(blocks.names());
  file.write(foam_head("regIOobject", "cellZones") + std::to_string(names.size()) + "\n(\n");
  for (std::int32_t block = 0; block < blocks.count(); ++block) {
    std::int64_t cells = 0, before = 0;
    for_each_kind([&]<CellKind kind>() { cells += comm.sum(blocks.rows<kind>(block).size()); });
    file.write(names[block] + "\n{\n    type cellZone;\n    cellLabels      List<label>\n" +
               std::to_string(cells) + "\n(\n");
    for_each_kind([&]<CellKind kind>() {
      const BlockRows rows = blocks.rows<kind>(block);
      const std::int64_t first = before + comm.exclusive_sum(stream.cell_rows<kind>());
      file.write_rows(rows.size(), 1,
                      [&](TextRows& text, std::int64_t i) { text.put(first + rows[i], '\n'); });
      before += stream.counts().of(kind);
    });
    file.write(")\n;\n}\n");
  }
  file.write(")\n");
  file.close();
}

}  // namespace quadloop
