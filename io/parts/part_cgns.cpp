#include "io/parts/part_cgns.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "io/cgns/cgns_layout.hpp"
#include "io/cgns/cgns_nodes.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

void put_part_into_cgns(const StagedFile& staged, const MeshPart& part, std::int32_t parts) {
  constexpr const char *data = "UserDefinedData_t", *array = "DataArray_t";
  CgnsNodes nodes(staged, CgnsNodes::State::existing);
  {  // HDF5 keeps a file open as long as any object in it is open
    const CgnsNodes::Node zone = nodes.at(CgnsLayout::path_of_zone(CgnsLayout::only_zone)),
                          here = nodes.add(zone, "Part", data);
    const auto put = [&](const CgnsNodes::Node& parent, const std::string& name, const auto& numbers,
                         const auto& number_of) {
      if (numbers.empty()) return;  // CGNS has no empty arrays
      std::vector<std::int32_t> from_one;
      for (const auto& entry : numbers) {
        const std::int64_t number = number_of(entry) + 1;
        if (number > std::numeric_limits<std::int32_t>::max())
          throw OutputError(staged.path +
                            ": the whole mesh has more entries than this CGNS library can count; "
                            "write .mesh files instead");
        from_one.push_back(static_cast<std::int32_t>(number));
      }
      nodes.add_integers(parent, name, array, from_one);
    };
    const auto itself = [](std::int64_t number) { return number; };
    put(here, "Number", std::array{part.number, parts - 1}, itself);
    put(here, "GlobalNodeNumber", part.nodes, itself);
    put(here, "NodeOwner", part.owners, itself);
    put(here, "GlobalTriangleNumber", part.triangles, itself);
    put(here, "GlobalQuadNumber", part.quads, itself);
    for (const MeshPart::Neighbour& neighbour : part.neighbours) {
      const CgnsNodes::Node with = nodes.add(here, part_name(neighbour.part), data);
      put(with, "SharedNodes", neighbour.nodes, [](NodeId node) { return std::int64_t{node.value()}; });
    }
  }
  nodes.close();
}

}  // namespace quadloop::io
