#pragma once

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Reports what an unsmoothed mesh has lost of its geometry (apart from islands dropped before): a warning
/// with the number of feature points that are not nodes, and the names of boundaries without edges. Throws
/// InputError if a boundary is lost, unless `may_vanish`. *Collective.*
void report_losses(const Communicator& comm, const Geometry& geometry, const Mesh& mesh, bool may_vanish,
                   MeshReport& report);

/// Throws InputError on all ranks if the areas enclosed by mesh and geometry differ by more than
/// largest_area_error, as the mesh is then too coarse for the geometry. `dropped` is the area of the
/// geometry's dropped loops (negative for islands); the area must fit with or without them. `smoothed`: the
/// mesh did fit before smoothing. *Collective.*
void require_area(const Communicator& comm, const Geometry& geometry, double dropped, const Mesh& mesh,
                  bool smoothed = false);

/// Returns the signed area of the loop: positive if its inside is part of the domain.
double area_of_loop(const Geometry& geometry, std::int32_t loop);

/// Returns the number of connected regions of the domain, each of one block or several: around each there is
/// one counter-clockwise walk. A closed baffle separates its inside.
std::int64_t regions_of(const Geometry& geometry);

/// Throws InputError for lost boundaries: the first with its size, the number of others, and the remedy.
/// `why` ends "which ...".
[[noreturn]] void refuse_vanished(const Geometry& geometry, const std::vector<std::string>& vanished,
                                  const std::string& why);

}  // namespace quadloop
