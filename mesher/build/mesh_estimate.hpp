#pragma once

#include <string>

#include "mesher/build/build_mesh.hpp"
#include "mesher/build/sized_domain.hpp"
#include "mesher/sizes/leaf_estimate.hpp"

namespace quadloop {

/// What a mesh of this geometry will cost, within a factor of 1.5 as a rule: from a sample of the tree,
/// without making it. The time grows with the levels and the segments, not with the cells. The same on any
/// number of ranks; not collective. Boundaries with layers are taken for the front, on whose edges the layers
/// are to stand. `leaves` are what estimate_leaves() says of the domain.
MeshEstimate estimate_mesh(const Geometry& geometry, MeshType type, SizedDomain& domain,
                           const LeafEstimate& leaves);

/// The same of a mesh that build_mesh would make. Throws InputError where no domain is left.
MeshEstimate estimate_mesh(const Geometry& geometry, const MeshOptions& options,
                           const DemandedSplits& demanded);

/// How much of what is allowed it takes: above 1 it is refused.
double share_of(const MeshLimit& limit, const MeshEstimate& estimate);

/// Of memory, over so many ranks.
double total_bytes(const MeshEstimate& estimate, int ranks);

/// As in "1.2 GiB".
std::string text_of_bytes(double bytes);

/// As in "12340" or "1.2e+06".
std::string text_of_cells(double cells);

/// The setting that asks for more than half of the cells, as in "spacing.max = 1e-06 asks for most of them";
/// empty where none does. Takes an estimate for each setting.
std::string cause_of_cells(const MeshEstimate& estimate, const Geometry& geometry,
                           const MeshOptions& options);

/// Throws TooManyCells where the estimate passes options.limit: how many cells, which settings ask for most
/// of them, and what would fit.
void require_within(const MeshEstimate& estimate, const Geometry& geometry, const MeshOptions& options,
                    const DemandedSplits& demanded);

}  // namespace quadloop
