#pragma once

#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

/// The edges relevant for refinement: excludes edges across layers, whose heights do not change when their
/// columns get narrower, and all edges within strips, whose columns do not change.
class TellingEdges {
 public:
  /// *Collective.*
  TellingEdges(const Communicator& comm, const Mesh& mesh) {
    if (has_layers(mesh)) places_ = layer_places(comm, mesh);
  }

  /// For a change along the edge.
  bool tells(NodeId from, NodeId to) const {
    if (places_.empty()) return true;
    const LayerPlace &a = places_[from], &b = places_[to];
    if (!a.valid() || !b.valid()) return true;
    return a.left == b.left && (a.strip < 0 || b.strip < 0);
  }
  /// For a change from the cell on one side of the edge to the cell on the other.
  bool tells_across(NodeId from, NodeId to) const {
    if (places_.empty()) return true;
    const LayerPlace &a = places_[from], &b = places_[to];
    if (!a.valid() || !b.valid()) return true;
    const bool ends_layers = a.left == 0 && b.left == 0;
    return ends_layers || (a.left != b.left && (a.strip < 0 || b.strip < 0));
  }

 private:
  LayerPlaces places_;
};

}  // namespace quadloop::adapt
