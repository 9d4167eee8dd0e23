#pragma once

// For io/cgns only.
#include <cstdint>
#include <set>
#include <span>
#include <string>

#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_nodes.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::io {

/// Adds the boundaries to a CGNS file, on rank 0: for each one or more sections of bars or faces, whose nodes
/// are written later, a family with its condition, and a BC over all of them that refers to the family. VTK
/// and ParaView show boundaries, except walls, only in this form. A boundary in several zones is one family.
class CgnsPatches {
 public:
  explicit CgnsPatches(CgnsNodes& nodes);

  /// The patches that follow are those of a zone; `first_element` is the number of its first bar or face.
  void begin_zone(const std::string& zone, std::int64_t first_element);
  void end_zone();

  void begin_patch() { first_ = next_; }
  /// Adds a section to the current patch.
  CgnsNodes::Node add_section(const std::string& name, ElementType_t type, std::int64_t elements);
  /// Stores the original name of a node, unless that is its name in the file.
  void put_full_name(const CgnsNodes::Node& node, const std::string& in_file, const std::string& name);
  /// Call after the last section of the patch has begun. `boundary` provides original name, condition and
  /// layers.
  void put_condition(const std::string& name, const BoundaryEdges& boundary, GridLocation_t location);

  /// Writes strips and pairs, as comments_of() the mesh, as a descriptor of the zone.
  void put_comments(const std::string& comments);
  /// Writes a pair as two vertex connections of the zone with itself, one for each direction. A rotation in
  /// the plane has no place in the angles of a base of two dimensions: of it only the nodes are written.
  void put_pair(const std::string& zone, const std::string& name, const PeriodicPair& pair,
                const PairedNodes& nodes);

  /// Writes the nodes of a zone that another one, the donor, also has: lists of the same length, from 1, in
  /// the same order.
  CgnsNodes::Node put_connection(const std::string& zone, const std::string& name, const std::string& donor,
                                 std::span<const std::int64_t> nodes, std::span<const std::int64_t> of_donor);
  /// Writes the number of a zone among all, from 1, as libcgns sorts them by name, and its original name.
  void put_block(const std::string& zone, std::int32_t number, const std::string& name);

 private:
  void put_translation(const CgnsNodes::Node& connection, Point translation);

  CgnsNodes& nodes_;
  CgnsNodes::Node base_, zone_, conditions_;
  std::set<std::string> families_, connected_;  ///< names of families; of zones with connections
  std::int64_t first_ = 0, next_ = 1;
};

}  // namespace quadloop::io
