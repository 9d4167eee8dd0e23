#pragma once

#include <string>

#include "mesher/build/build_mesh.hpp"
#include "mesher/build/sized_domain.hpp"
#include "mesher/sizes/leaf_estimate.hpp"

namespace quadloop {

/// Estimates the size of a mesh of this geometry, usually within a factor of 1.5, from a sample of the tree.
/// The time grows with the levels and the segments, not with the cells. Independent of the number of ranks;
/// not collective. Boundaries with layers are taken as the outer edge, on whose edges the columns will be.
/// `leaves` is the result of estimate_leaves() for the domain.
MeshEstimate estimate_mesh(const Geometry& geometry, MeshType type, SizedDomain& domain,
                           const LeafEstimate& leaves);

/// The same for a mesh that build_mesh() would generate. Throws InputError if no domain remains.
MeshEstimate estimate_mesh(const Geometry& geometry, const MeshOptions& options,
                           const DemandedSplits& demanded);

/// Returns the used fraction of the limit; above 1 the mesh is rejected.
double share_of(const MeshLimit& limit, const MeshEstimate& estimate);

/// Returns the total memory over this number of ranks.
double total_bytes(const MeshEstimate& estimate, int ranks);

/// Formats as "1.2 GiB".
std::string text_of_bytes(double bytes);

/// Formats as "12340" or "1.2e+06".
std::string text_of_cells(double cells);

/// Returns the setting responsible for more than half of the cells, e.g. "spacing.max = 1e-06 asks for most
/// of them"; empty if there is none. Needs one estimate per setting.
std::string cause_of_cells(const MeshEstimate& estimate, const Geometry& geometry,
                           const MeshOptions& options);

/// Throws TooManyCells if the estimate exceeds options.limit, with the number of cells, the settings
/// responsible for most of them, and values that fit.
void require_within(const MeshEstimate& estimate, const Geometry& geometry, const MeshOptions& options,
                    const DemandedSplits& demanded);

}  // namespace quadloop
