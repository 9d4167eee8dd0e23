#include "io/cgns/cgns_connections.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr DataType_t cgsize_type = sizeof(cgsize_t) == 4 ? Integer : LongInteger;

}  // namespace

std::int32_t node_of_zone(const CgnsFile& file, const std::string& zone, cgsize_t number, cgsize_t nodes,
                          std::size_t first) {
  if (number < 1 || number > nodes) {
    throw InputError(file.shown() + ": zone " + zone + ": an element names node " + std::to_string(number) +
                     ", which is none of 1 to " + std::to_string(nodes));
  }
  return static_cast<std::int32_t>(first + number - 1);
}

void CgnsConnections::refuse(const std::string& message) const {
  throw InputError(zone_.file.shown() + ": zone " + name_ + ": " + message);
}

void CgnsConnections::read(std::vector<ZoneConnection>& connections, FileMesh& mesh) const {
  int count = 0;
  zone_.file.check(cg_nconns(zone_.file.id(), 1, zone_.zone, &count));
  for (int connection = 1; connection <= count; ++connection) {
    std::array<float, 3> centre{}, angle{}, shift{};
    if (cg_conn_periodic_read(zone_.file.id(), 1, zone_.zone, connection, centre.data(), angle.data(),
                              shift.data()) != CG_OK)
      read_one(connection, connections);
    else if (mesh.dimension == 2)
      mark_periodic(connection, mesh);
  }
}

CgnsConnections::Connectivity CgnsConnections::connectivity(int connection) const {
  Connectivity c;
  ZoneType_t donor_zone = ZoneTypeNull;
  DataType_t donor_type = DataTypeNull;
  zone_.file.check(cg_conn_info(zone_.file.id(), 1, zone_.zone, connection, c.name.data(), &c.location,
                                &c.type, &c.set, &c.count, c.donor.data(), &donor_zone, &c.donor_set,
                                &donor_type, &c.donors));
  return c;
}

/// Takes lists of nodes only: nodes that are connected in other ways are found by their places.
void CgnsConnections::read_one(int connection, std::vector<ZoneConnection>& connections) const {
  const auto [name, donor, location, type, set, donor_set, count, donors] = connectivity(connection);
  const bool lists_nodes = type == Abutting1to1 && location == Vertex && set == PointList &&
                           donor_set == PointListDonor && count > 0 && count == donors;
  if (!lists_nodes || donor.data() == name_) return;
  if (count > zone_.nodes)
    refuse("connectivity " + std::string(name.data()) + " lists " + std::to_string(count) +
           " nodes, which is more than there are");
  ZoneConnection& own = connections.emplace_back();
  own.zone = number_;
  own.donor = donor.data();
  own.nodes.resize(count);
  own.of_donor.resize(count);
  zone_.file.check(cg_conn_read(zone_.file.id(), 1, zone_.zone, connection, own.nodes.data(), cgsize_type,
                                own.of_donor.data()));
}

void CgnsConnections::mark_periodic(int connection, FileMesh& mesh) const {
  const Connectivity about = connectivity(connection);
  const cgsize_t count = about.count;
  if (count < 1) return;
  std::vector<cgsize_t> numbers(count);
  zone_.file.check(cg_conn_read_short(zone_.file.id(), 1, zone_.zone, connection, numbers.data()));
  if (about.set == PointRange && count == 2) {
    if (numbers[1] - numbers[0] > std::max<std::int64_t>(zone_.nodes, faces_.size()))
      refuse("connectivity " + std::string(about.name.data()) + " is of " + std::to_string(numbers[0]) +
             " to " + std::to_string(numbers[1]) + ", which is more than there are");
    for (cgsize_t number = numbers[0] + 1; number < numbers[1]; ++number) numbers.push_back(number);
  }
  for (const cgsize_t number : numbers) {
    if (about.location == Vertex)
      mesh.periodic_nodes.push_back(node_of_zone(zone_.file, name_, number, zone_.nodes, first_node_));
    else if (const auto edge = faces_.find(number))
      mesh.periodic_nodes.insert(mesh.periodic_nodes.end(), edge->begin(), edge->begin() + 2);
  }
}

NodeLinks links_of(const std::vector<ZoneConnection>& connections, const std::vector<std::string>& names,
                   const std::vector<std::size_t>& first_nodes, std::size_t nodes, const std::string& path) {
  const auto number_of = [&](std::size_t zone, cgsize_t node) {
    const std::size_t end = zone + 1 < first_nodes.size() ? first_nodes[zone + 1] : nodes;
    if (node < 1 || node > std::int64_t(end - first_nodes[zone]))
      throw InputError(path + ": zone " + names[zone] + ": a connectivity names node " +
                       std::to_string(node) + ", which is none of 1 to " +
                       std::to_string(end - first_nodes[zone]));
    return static_cast<std::int32_t>(first_nodes[zone] + node - 1);
  };
  NodeLinks links;
  for (const ZoneConnection& connection : connections) {
    const std::size_t donor = std::ranges::find(names, connection.donor) - names.begin();
    if (donor == names.size())
      throw InputError(path + ": zone " + names[connection.zone] + " is connected with zone " +
                       connection.donor + ", which does not exist");
    links.zones.insert({std::min(donor, connection.zone), std::max(donor, connection.zone)});
    for (std::size_t i = 0; i < connection.nodes.size(); ++i)
      links.nodes.push_back(
          {number_of(connection.zone, connection.nodes[i]), number_of(donor, connection.of_donor[i])});
  }
  return links;
}

}  // namespace quadloop::io
