#include "io/vtu/vtu_boundaries.hpp"

#include <fmt/format.h>

#include <array>

#include "io/model/repeated_rows.hpp"
#include "io/stream/vtk_cell.hpp"

namespace quadloop::io {

namespace {

/// Arrays of meshio for Gmsh and Medit; of VTK and ParaView for Gmsh entities.
constexpr std::array group_arrays{"gmsh:physical", "medit:ref", "CellEntityIds", "gmsh:geometrical"};

bool is_of_numbers(const VtuArray& array) {
  return array.section == "CellData" && array.components == 1 && !array.type.starts_with("Float") &&
         array.type != "String";
}

/// Reads field data with two numbers each: those of a physical group, and its dimension.
std::unordered_map<std::int64_t, std::string> group_names(const VtuDocument& document,
                                                          const VtuNumbers& numbers, std::int64_t dimension) {
  std::unordered_map<std::int64_t, std::string> names;
  for (const VtuArray& array : document.arrays) {
    if (array.section != "FieldData" || array.type.starts_with("Float") || array.type == "String") continue;
    const std::vector<std::int64_t> group = numbers.integers(array, std::nullopt);
    if (group.size() == 2 && group[1] == dimension) names.try_emplace(group[0], array.name);
  }
  return names;
}

}  // namespace

VtuBoundaryNumbers find_boundary_numbers(const VtuDocument& document, const VtuNumbers& numbers,
                                         const std::vector<std::int64_t>& types, std::int64_t first_type,
                                         std::int64_t last_type) {
  const auto of = [&](const std::string& name) {
    const VtuArray* array = document.find("CellData", name);
    return array != nullptr && is_of_numbers(*array) ? numbers.integers(*array, document.cells)
                                                     : std::vector<std::int64_t>{};
  };
  if (auto ours = of("boundary"); !ours.empty()) return {std::move(ours), true, {}};
  const auto is_boundary = [&](std::size_t cell) {
    return types[cell] >= first_type && types[cell] <= last_type;
  };
  std::size_t elements = 0;
  for (std::size_t cell = 0; cell < types.size(); ++cell) elements += is_boundary(cell) ? 1 : 0;
  if (elements < 2) return {};
  for (const char* name : group_arrays) {
    std::vector<std::int64_t> found = of(name);
    std::optional<std::int64_t> first;
    bool differ = false;
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
      if (!is_boundary(cell)) continue;
      differ = differ || (first && *first != found[cell]);
      first = found[cell];
    }
    if (differ)
      return {std::move(found), false, fmt::format("the cell data '{}' distinguish its boundaries", name),
              group_names(document, numbers, first_type == vtk_line ? 1 : 2)};
  }
  std::vector<std::string> others;
  for (const VtuArray& array : document.arrays) {
    if (is_of_numbers(array)) others.push_back(array.name);
  }
  std::string warning = "no cell data distinguish its boundaries; they form one boundary";
  if (!others.empty())
    warning += fmt::format("; where {} number{} them, call these cell data 'boundary'", some_names(others),
                           others.size() == 1 ? "s" : "");
  return {{}, false, warning};
}

std::string VtuBoundaryNumbers::name_of(std::int64_t number) const {
  const auto found = names.find(number);
  return found == names.end() ? fmt::format("boundary_{}", number) : found->second;
}

}  // namespace quadloop::io
