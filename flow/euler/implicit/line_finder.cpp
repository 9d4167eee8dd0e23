#include "flow/euler/implicit/line_finder.hpp"

#include <algorithm>
#include <limits>

#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::flow::euler {

namespace {

/// Ratio to the third strongest coupling: cells about three times as long as high.
constexpr double strong = 10;
constexpr std::int64_t nobody = -1;

/// The strongly coupled edges of a node, two at most: global numbers of the nodes at their other ends.
struct Partners {
  std::array<std::int64_t, 2> nodes{nobody, nobody};
  bool contains(GlobalNodeId node) const { return nodes[0] == node.value() || nodes[1] == node.value(); }
};

struct Coupled {
  double strength = 0;
  std::int64_t node = nobody;
};

/// The three strongest edges of a node in this order; of equal ones the first comes first.
struct Strongest {
  std::array<Coupled, 3> edges;
  int count = 0;

  void add(const Coupled& edge) {
    ++count;
    std::size_t at = edges.size();
    while (at > 0 && edge.strength > edges[at - 1].strength) --at;
    if (at == edges.size()) return;
    std::move_backward(edges.begin() + static_cast<std::ptrdiff_t>(at), edges.end() - 1, edges.end());
    edges[at] = edge;
  }
  Partners partners() const {
    Partners result;
    const std::size_t weak = std::min(count, 3) - 1;  // of the two edges of a corner node the second
    for (std::size_t k = 0; k < weak; ++k) {
      if (edges[k].strength >= strong * edges[weak].strength) result.nodes[k] = edges[k].node;
    }
    return result;
  }
};

/// An owned node of a line, as sent to the rank that assembles the line.
struct Member {
  std::int64_t line;  ///< smallest number of the line's nodes
  std::int64_t node;
  Partners partners;
  double strength;  ///< of its strongest edge
  int rank;
  std::int8_t colour;
};

/// A node with its position in a line.
struct Place {
  std::int64_t line, node;
  std::int32_t place;
  std::int8_t colour;
};

class LineFinder {
 public:
  LineFinder(const Communicator& comm, const DualMesh& mesh, const Colouring& colours)
      : comm_{comm},
        mesh_{mesh},
        colours_{colours},
        owners_(comm, mesh.first_node()),
        strongest_(mesh.nodes()),
        partners_(mesh.nodes()) {}

  std::vector<NodeLine> find() {
    choose_partners();
    join();
    name_lines();
    return received(put_together(members()));
  }

 private:
  void choose_partners() {
    for (const DualEdge& edge : mesh_.edges()) {
      const double strength = edge.size / length(edge.half);
      strongest_[edge.low].add({strength, mesh_.global(edge.high).value()});
      strongest_[edge.high].add({strength, mesh_.global(edge.low).value()});
    }
    for (const NodeId node : mesh_.owned_ids()) partners_[node] = strongest_[node].partners();
    mesh_.exchange().update(partners_);
  }

  /// Keeps the edges that are strong at both of their nodes, except across periodic pairs.
  void join() {
    IdVector<NodeId, Partners> common(mesh_.owned_nodes());
    const auto note = [&](NodeId node, GlobalNodeId other) {
      if (!mesh_.is_owned(node)) return;
      auto& nodes = common[node].nodes;
      nodes[nodes[0] == nobody ? 0 : 1] = other.value();
    };
    for (const DualEdge& edge : mesh_.edges()) {
      if (mesh_.is_image(edge.low) || mesh_.is_image(edge.high)) continue;  // lines end at periodic pairs
      const GlobalNodeId low = mesh_.global(edge.low), high = mesh_.global(edge.high);
      if (!partners_[edge.low].contains(high) || !partners_[edge.high].contains(low)) continue;
      joints_.push_back({edge.low, edge.high});
      note(edge.low, high);
      note(edge.high, low);
    }
    partners_ = std::move(common);
  }

  /// Names each line by the smallest number of its nodes, propagated along the line, across ranks.
  void name_lines() {
    for (const NodeId node : mesh_.ids()) names_.push_back(mesh_.global(node).value());
    bool changed = true;
    while (comm_.any(changed)) {
      changed = false;
      while (names_spread()) changed = true;
      mesh_.exchange().update(names_);
      // a ghost's new name must reach this rank's nodes in the next round
      changed = changed || names_differ();
    }
  }

  bool names_spread() {
    bool changed = false;
    const auto spread = [&](const std::array<NodeId, 2>& joint) {
      std::int64_t &a = names_[joint[0]], &b = names_[joint[1]];
      changed = changed || a != b;
      a = b = std::min(a, b);
    };
    std::for_each(joints_.begin(), joints_.end(), spread);
    std::for_each(joints_.rbegin(), joints_.rend(), spread);
    return changed;
  }

  bool names_differ() const {
    return std::ranges::any_of(joints_,
                               [&](const auto& joint) { return names_[joint[0]] != names_[joint[1]]; });
  }

  /// Sends members to the owner of the node that names the line.
  std::vector<Member> members() const {
    Outbox<Member> out;
    for (const NodeId node : mesh_.owned_ids()) {
      if (partners_[node].nodes[0] == nobody) continue;
      const std::int64_t name = names_[node];
      out.add(owners_.rank_of(GlobalNodeId{name}),
              {name, mesh_.global(node).value(), partners_[node], strongest_[node].edges[0].strength,
               comm_.rank(), colours_.colour_of[node]});
    }
    std::vector<Member> all = out.deliver(comm_);
    std::ranges::sort(all, [](const Member& a, const Member& b) {
      return a.line != b.line ? a.line < b.line : a.node < b.node;
    });
    return all;
  }

  /// Sends each line, in order, to the ranks that own part of it.
  std::vector<Place> put_together(const std::vector<Member>& members) const {
    Outbox<Place> out;
    for (auto begin = members.begin(); begin != members.end();) {
      const auto end =
          std::find_if(begin, members.end(), [&](const Member& m) { return m.line != begin->line; });
      const std::vector<const Member*> line = in_order({begin, end});
      std::vector<int> ranks;
      for (const Member* member : line) ranks.push_back(member->rank);
      std::ranges::sort(ranks);
      const auto same = std::ranges::unique(ranks);
      ranks.erase(same.begin(), same.end());
      for (const int rank : ranks) {
        for (std::size_t k = 0; k < line.size(); ++k)
          out.add(rank, {line[k]->line, line[k]->node, static_cast<std::int32_t>(k), line[0]->colour});
      }
      begin = end;
    }
    return out.deliver(comm_);
  }

  /// Starts from the end with the stronger edge; a ring starts with its first node and is cut before it.
  static std::vector<const Member*> in_order(std::span<const Member> members) {
    const auto find = [&](std::int64_t node) -> const Member* {
      const auto found = std::ranges::lower_bound(members, node, {}, &Member::node);
      return found != members.end() && found->node == node ? &*found : nullptr;
    };
    const Member* start = nullptr;
    for (const Member& member : members) {
      if (member.partners.nodes[1] == nobody && (start == nullptr || member.strength > start->strength))
        start = &member;
    }
    if (start == nullptr) start = members.data();
    std::vector<const Member*> line;
    for (const Member *at = start, *before = nullptr; at != nullptr;) {
      line.push_back(at);
      const Member* next = nullptr;
      for (const std::int64_t partner : at->partners.nodes) {
        const Member* other = find(partner);
        if (other != nullptr && other != before && other != start && next == nullptr) next = other;
      }
      before = at;
      at = next;
    }
    return line;
  }

  static std::vector<NodeLine> received(std::vector<Place> places) {
    std::ranges::sort(places, [](const Place& a, const Place& b) {
      return a.line != b.line ? a.line < b.line : a.place < b.place;
    });
    std::vector<NodeLine> lines;
    for (const Place& place : places) {
      if (place.place == 0) lines.push_back({{}, place.colour});
      lines.back().nodes.push_back(GlobalNodeId{place.node});
    }
    return lines;
  }

  const Communicator& comm_;
  const DualMesh& mesh_;
  const Colouring& colours_;
  NodeOwners owners_;
  IdVector<NodeId, Strongest> strongest_;
  IdVector<NodeId, Partners> partners_;
  std::vector<std::array<NodeId, 2>> joints_;
  IdVector<NodeId, std::int64_t> names_;  ///< line of each node
};

}  // namespace

std::vector<NodeLine> find_lines(const Communicator& comm, const DualMesh& mesh, const Colouring& colours) {
  return LineFinder(comm, mesh, colours).find();
}

}  // namespace quadloop::flow::euler
