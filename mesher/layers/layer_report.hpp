#pragma once

#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/boundary_layer_report.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Reports the layers that add_layers() puts between the wall and the front's nodes; `outer` is the mesh
/// outside them. The same on any number of ranks. *Collective.*
LayerReport report_layers(const Communicator& comm, const LayerFront& front, const Mesh& outer);

/// Reports one strip as built.
BoundaryLayerReport report_strip(const LayerStrip& strip);

/// Warnings about boundaries whose layers are somewhere thinner than half the requested thickness, with the
/// place: the thinnest first, at most five, and a line that counts the others.
std::vector<std::string> warnings_of(const LayerReport& report);

/// Warnings where `min`, the smallest allowed leaf size, exceeds the size that layers need: beside the last
/// layers of walls that have at least half their requested thickness (the five boundaries with the largest
/// difference), beside strips, and on bases of blunt edges that are too narrow for layers of their own; and
/// of wakes that turn by more than 15 degrees at their edge. Each with its place.
std::vector<std::string> size_warnings(const LayerFront& front, double min);

}  // namespace quadloop
