#pragma once

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// What an unsmoothed mesh has lost of the outline that it was cut from (without the islands dropped before):
/// a warning with their number for kept corners that are no nodes, and the names of boundaries without an
/// edge. *Collective.* Throws InputError where one vanished, unless `may_vanish`.
void report_losses(const Communicator& comm, const Geometry& geometry, const Mesh& mesh, bool may_vanish,
                   MeshReport& report);

/// Throws InputError on all ranks where the areas that the mesh and the outline enclose differ by more than
/// largest_area_error: so coarse a mesh is none of that geometry. `dropped` is the area of the geometry's
/// loops that were dropped (below 0 for islands); with and without them the area must fit. `smoothed` tells
/// that the mesh fitted before its nodes moved. *Collective.*
void require_area(const Communicator& comm, const Geometry& geometry, double dropped, const Mesh& mesh,
                  bool smoothed = false);

/// The signed area inside the loop: above 0 where its inside is domain.
double area_of_loop(const Geometry& geometry, std::int32_t loop);

/// How many connected regions the domain has: each has one loop with its inside in the domain.
std::int64_t regions_of(const Geometry& geometry);

/// Throws InputError for boundaries that vanish: the first with its size, how many more, and the cure. `why`
/// ends "which ...".
[[noreturn]] void refuse_vanished(const Geometry& geometry, const std::vector<std::string>& vanished,
                                  const std::string& why);

}  // namespace quadloop
