#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"

namespace quadloop {

/// A boundary condition of a zone, by the elements that it names: a list, or the two ends of a range.
struct CgnsCondition {
  std::array<char, 33> name{};
  BCType_t type = BCTypeNull;
  bool is_range = false;
  std::vector<cgsize_t> elements;
};

/// The condition of a number from 1; none where it names nodes instead of elements. `refuse(message)`, which
/// does not return, is called where its numbers are no list and no range.
template <class Refuse>
std::optional<CgnsCondition> read_condition(const CgnsFile<InputError>& file, int base, int zone, int number,
                                            const Refuse& refuse) {
  CgnsCondition condition;
  PointSetType_t set = PointSetTypeNull;
  cgsize_t count = 0, normals = 0;
  std::array<int, 3> normal{};
  DataType_t normal_type = DataTypeNull;
  int datasets = 0;
  file.check(cg_boco_info(file.id(), base, zone, number, condition.name.data(), &condition.type, &set, &count,
                          normal.data(), &normals, &normal_type, &datasets));
  GridLocation_t location = Vertex;
  file.check(cg_boco_gridlocation_read(file.id(), base, zone, number, &location));
  if (set != ElementRange && set != ElementList && location == Vertex) return std::nullopt;
  condition.is_range = set == PointRange || set == ElementRange;
  if (count < 0 || (condition.is_range && count != 2))
    refuse("boundary " + std::string(condition.name.data()) + " has " + std::to_string(count) +
           " numbers where " + (condition.is_range ? "a range has 2" : "a list is"));
  condition.elements.resize(count);
  file.check(cg_boco_read(file.id(), base, zone, number, condition.elements.data(), nullptr));
  return condition;
}

}  // namespace quadloop
