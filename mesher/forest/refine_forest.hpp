#pragma once

#include "mesher/forest/forest.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/forest/size_tree.hpp"

namespace quadloop {

/// The smallest forest that the size tree allows and in which no leaf lies between two finer ones on opposite sides (thesis Fig. 3.4 (a)),
/// so that a leaf has at most two hanging nodes, on adjacent sides. Leaves are shared out evenly by number. *Collective.*
Forest refine_forest(const Communicator& comm, SizeTree& sizes);

}  // namespace quadloop
