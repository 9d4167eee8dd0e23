#include "io/solid/extruded_stream.hpp"

#include <numeric>

namespace quadloop {

ExtrudedStream::ExtrudedStream(const Communicator& comm, const ExtrudedMesh& mesh)
    : comm_{comm}, mesh_{mesh}, counts_{comm, mesh}, boundaries_{comm, mesh.plane} {
  for (std::size_t n = 0; n < boundaries_.present().size(); ++n) {
    const BoundaryEdges& boundary = *boundaries_.present()[n];
    patches_.push_back({boundary.name, boundary.condition, 0, boundaries_.edges_of(n) * mesh.layers()});
  }
  for (const std::string& end : {mesh.back, mesh.front})
    patches_.push_back({end, "symmetry", counts_.triangles, counts_.quads});
}

std::vector<std::string> ExtrudedStream::patch_names() const {
  std::vector<std::string> names;
  for (const ExtrudedPatch& patch : patches_) names.push_back(patch.name);
  return names;
}

std::int64_t ExtrudedStream::patch_quads() const {
  return std::accumulate(patches_.begin(), patches_.end(), std::int64_t{0},
                         [](std::int64_t sum, const ExtrudedPatch& patch) { return sum + patch.quads; });
}

}  // namespace quadloop
