#pragma once

// Inside io/cgns only.
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

namespace quadloop {

/// The boundaries, on rank 0, once the rest of a CGNS file is written: for each one or more sections of bars
/// or faces, a family that says what it is, and a BC over all of them that points to the family: VTK and
/// ParaView show a boundary only where its BC is given so, walls excepted.
class CgnsPatches {
 public:
  /// `first_element` is the number of the first bar or face.
  CgnsPatches(const StagedFile& staged, std::int64_t first_element);

  void begin_patch() { first_ = next_; }
  /// Of the patch under way; its elements are put before the next begins.
  void begin_section(const std::string& name, ElementType_t type, std::int64_t elements);
  /// After the last section of the patch was begun. `boundary` tells its own name, condition and layers.
  void put_condition(const std::string& name, const BoundaryEdges& boundary, GridLocation_t location);

  /// Nodes of elements, from 1.
  void put(std::span<const cgsize_t> nodes) { elements_->put(nodes); }
  void put(std::span<const BoundaryStream::Edge> edges);

  /// Strips by their nodes, as a descriptor of the zone.
  void put_strips(const std::vector<StripLayers>& strips);

  void close();

 private:
  CgnsNodes nodes_;
  CgnsNodes::Node base_, zone_, conditions_;
  std::optional<CgnsNodes::Array> elements_;
  cgsize_t first_ = 0, next_;
};

}  // namespace quadloop
