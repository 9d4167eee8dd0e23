#pragma once

// For io/cgns only.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/cgns/cgns_faces.hpp"
#include "io/cgns/cgns_handle.hpp"
#include "io/cgns/cgns_values.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// The nodes of a zone that are nodes of another one, by its name: numbers in the zones, from 1.
struct ZoneConnection {
  std::size_t zone;  ///< from 0, in the order of reading
  std::string donor;
  std::vector<cgsize_t> nodes, of_donor;
};

/// Reads the connectivities of a zone: the nodes that other zones have too and, in a plane mesh, those on
/// this zone's side of connectivities with a Periodic_t node; usually each side has its own.
class CgnsConnections {
 public:
  /// `zone` is the zone `number`, from 0, in the order of reading; its nodes follow `first_node` others.
  CgnsConnections(const CgnsZone& zone, std::string name, std::size_t number, std::size_t first_node,
                  const CgnsFaces& faces)
      : zone_{zone}, name_{std::move(name)}, number_{number}, first_node_{first_node}, faces_{faces} {}

  /// Appends periodic nodes to those of the mesh. Throws InputError.
  void read(std::vector<ZoneConnection>& connections, FileMesh& mesh) const;

 private:
  /// What libcgns tells of a GridConnectivity_t node.
  struct Connectivity {
    std::array<char, 33> name{}, donor{};
    GridLocation_t location = Vertex;
    GridConnectivityType_t type = GridConnectivityTypeNull;
    PointSetType_t set = PointSetTypeNull, donor_set = PointSetTypeNull;
    cgsize_t count = 0, donors = 0;
  };

  [[noreturn]] void refuse(const std::string& message) const;
  Connectivity connectivity(int connection) const;
  void read_one(int connection, std::vector<ZoneConnection>& connections) const;
  void mark_periodic(int connection, FileMesh& mesh) const;

  CgnsZone zone_;
  std::string name_;
  std::size_t number_, first_node_;
  const CgnsFaces& faces_;
};

/// Returns the node's number over all zones, from 0, of a number in a zone of `nodes`, named `zone`, that
/// follow `first` others. Throws InputError if the zone has no such node.
std::int32_t node_of_zone(const CgnsFile& file, const std::string& zone, cgsize_t number, cgsize_t nodes,
                          std::size_t first);

/// Returns the pairs of equal nodes, numbered over all zones. `names` and `first_nodes` are those of the
/// zones, `nodes` is the number of all nodes. Throws InputError, with `path`.
NodeLinks links_of(const std::vector<ZoneConnection>& connections, const std::vector<std::string>& names,
                   const std::vector<std::size_t>& first_nodes, std::size_t nodes, const std::string& path);

}  // namespace quadloop::io
