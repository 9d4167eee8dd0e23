// Mistakes that the types forbid. Without a macro this file compiles; with any one of them it must not.

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop {

constexpr NodeId node{3};
constexpr GlobalNodeId global_node{3};

static_assert(node == NodeId{3});
static_assert(!NodeId{}.valid());
static_assert(BoundaryCondition("farfield") == BoundaryCondition::farfield);

inline double value_at(const IdVector<NodeId, double>& values) { return values[node]; }

#if defined(LOCAL_FOR_GLOBAL)
constexpr GlobalNodeId mistake = node;
#elif defined(NODE_FOR_LEAF)
constexpr LeafId mistake = node;
#elif defined(NUMBER_FOR_ID)
constexpr NodeId mistake = 3;
#elif defined(ID_FOR_NUMBER)
constexpr int mistake = node;
#elif defined(NODE_AGAINST_LEAF)
constexpr bool mistake = node == LeafId{3};
#elif defined(SUM_OF_IDS)
constexpr auto mistake = node + node;
#elif defined(GLOBAL_SUBSCRIPT)
double mistake(const IdVector<NodeId, double>& values) { return values[global_node]; }
#elif defined(NUMBER_SUBSCRIPT)
double mistake(const IdVector<NodeId, double>& values) { return values[3]; }
#elif defined(VECTOR_FOR_ID_VECTOR)
double mistake() { return value_at(std::vector<double>{3}); }
#elif defined(VECTOR_OF_BITS)
IdVector<NodeId, bool> mistake;
#elif defined(COPIED_COMMUNICATOR)
Communicator mistake(const Communicator& comm) { return comm; }
#elif defined(UNKNOWN_CONDITION)
const BoundaryCondition mistake = "far_field";
#elif defined(TEXT_FOR_CONDITION)
BoundaryCondition mistake(const std::string& word) { return word; }
#endif

}  // namespace quadloop
