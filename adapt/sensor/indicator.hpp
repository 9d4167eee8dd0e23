#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// What is taken of a variable q, divided by its range, along an edge dx of the mesh (g: gradient at the
/// nodes). Of a variable of the cells dq is the jump across an edge, between two cells, and dx goes from the
/// centroid of one to that of the other; g comes from the cells round a node by least squares, and where
/// these lie on one line (at corners of the domain) there is none.
enum class Indicator {
  difference,  ///< |dq|
  gradient,    ///< |dq| / |dx|, in 1 / length
  hessian      ///< |dg . dx| along an edge: 0 where q is linear
};

inline constexpr WordTable<Indicator, 3> indicator_words{{{"difference", Indicator::difference},
                                                          {"gradient", Indicator::gradient},
                                                          {"hessian", Indicator::hessian}}};

/// For each leaf of this rank's share the largest indicator of any variable of the field on any edge of the
/// leaf's cells; 0 for leaves without cells. Variables of cells count by the edges between two cells, as
/// above. An edge counts for the leaves of both its cells, but
/// not one that crosses layers at a wall: these keep their heights when a leaf is split. A constant
/// variable adds nothing; what may be rounding of q (ScaledField::rounding) counts as 0 in the differences of
/// `difference`, `gradient` and in `hessian`. The mesh must be valid. The same bits on any number of ranks,
/// however leaves and cells are shared out. Throws InputError on all ranks for a value that is not finite, or
/// where the tree is not this mesh's. *Collective.*
std::vector<double> leaf_indicator(const Communicator& comm, const Mesh& mesh,
                                   std::span<const LeafRecord> leaves, const Field& field, Indicator kind);

/// For each leaf the largest of the solver's own error estimates, the field's only variable, at the nodes of
/// its cells, or in them; 0 for leaves without cells. Throws InputError as above, and for a negative error.
/// *Collective.*
std::vector<double> leaf_errors(const Communicator& comm, const Mesh& mesh,
                                std::span<const LeafRecord> leaves, const Field& error);

}  // namespace quadloop
