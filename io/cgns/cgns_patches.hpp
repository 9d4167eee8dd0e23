#pragma once

// For io/cgns only.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_nodes.hpp"
#include "io/files/boundary_stream.hpp"
#include "io/files/output_file.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop::io {

/// Writes the boundaries, on rank 0, after the rest of a CGNS file: for each one or more sections of bars or
/// faces, a family with its condition, and a BC over all of them that refers to the family. VTK and ParaView
/// show boundaries, except walls, only in this form.
class CgnsPatches {
 public:
  /// `first_element` is the number of the first bar or face.
  CgnsPatches(const StagedFile& staged, std::int64_t first_element);

  void begin_patch() { first_ = next_; }
  /// Begins a section of the current patch; its elements must be written before the next section.
  void begin_section(const std::string& name, ElementType_t type, std::int64_t elements);
  /// Call after the last section of the patch has begun. `boundary` provides original name, condition and
  /// layers.
  void put_condition(const std::string& name, const BoundaryEdges& boundary, GridLocation_t location);

  /// Node numbers of elements, from 1.
  void put(std::span<const cgsize_t> nodes) { elements_->put(nodes); }
  void put(std::span<const BoundaryStream::Edge> edges);

  /// Writes strips and pairs, as comments_of() the mesh, as a descriptor of the zone.
  void put_comments(const std::string& comments);
  /// Writes a pair as two vertex connections of the zone with itself, one for each direction. A rotation in
  /// the plane has no place in the angles of a base of two dimensions: of it only the nodes are written.
  void put_pair(const std::string& name, const PeriodicPair& pair, const PairedNodes& nodes);

  void close();

 private:
  void put_connection(const std::string& name, const BoundaryLine& from, const BoundaryLine& to,
                      const PeriodicPair* translated, float sign);

  CgnsNodes nodes_;
  CgnsNodes::Node base_, zone_, conditions_, connections_;
  std::optional<CgnsNodes::Array> elements_;
  cgsize_t first_ = 0, next_;
};

}  // namespace quadloop::io
