#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// Indicator of a variable q, divided by its range, along a mesh edge dx (g: gradient at the nodes). For cell
/// variables dq is the jump across the edge between two cells, and dx connects their centroids; g is a
/// least-squares gradient of the cells around a node, and is not used where these are collinear (at corners
/// of the domain).
enum class Indicator {
  difference,  ///< |dq|
  gradient,    ///< |dq| / |dx|, in 1 / length
  hessian      ///< |dg . dx| along an edge: 0 where q is linear
};

inline constexpr WordTable<Indicator, 3> indicator_words{{{"difference", Indicator::difference},
                                                          {"gradient", Indicator::gradient},
                                                          {"hessian", Indicator::hessian}}};

/// For each local leaf the largest indicator of any variable of the field on any edge of the leaf's cells; 0
/// for leaves without cells. Cell variables use the edges between two cells, as above. An edge counts for the
/// leaves of both its cells, except edges across layers at a wall, whose heights do not change when a leaf is
/// split. A constant variable adds nothing. Differences within the rounding of q (ScaledField::rounding)
/// count as 0. The mesh must be valid. The same bits on any number of ranks and for any partition. Throws
/// InputError on all ranks for a value that is not finite, or if the tree does not belong to this mesh.
/// *Collective.*
std::vector<double> leaf_indicator(const Communicator& comm, const Mesh& mesh,
                                   std::span<const LeafRecord> leaves, const Field& field, Indicator kind);

/// For each leaf the largest of the solver's own error estimates (the field's only variable) at the nodes of
/// its cells, or in them; 0 for leaves without cells. Throws InputError as above, and for a negative error.
/// *Collective.*
std::vector<double> leaf_errors(const Communicator& comm, const Mesh& mesh,
                                std::span<const LeafRecord> leaves, const Field& error);

}  // namespace quadloop::adapt
