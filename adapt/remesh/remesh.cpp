#include "adapt/remesh/remesh.hpp"

#include <algorithm>
#include <numeric>

#include "adapt/remesh/restart.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop {

namespace {

/// Texts without line ends, from the root to every rank.
std::vector<std::string> shared_names(const Communicator& comm, const std::vector<std::string>& names) {
  std::vector<char> text;
  for (const std::string& name : names) {
    text.insert(text.end(), name.begin(), name.end());
    text.push_back('\n');
  }
  comm.broadcast(text);
  std::vector<std::string> shared;
  for (auto begin = text.begin(); begin != text.end();) {
    const auto end = std::find(begin, text.end(), '\n');
    shared.emplace_back(begin, end);
    begin = end + 1;
  }
  return shared;
}

/// The file's own order: along the curve, as the tree has the cells.
MeshOrder order_of_file(const Mesh& whole) {
  const auto numbers = [](std::size_t count) {
    std::vector<std::int32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    return order;
  };
  return {numbers(whole.points.size()), numbers(whole.triangles.size()), numbers(whole.quads.size())};
}

}  // namespace

Solution share_solution(const Communicator& comm, const Solution& of_root) {
  Solution shared{of_root.constants, shared_names(comm, of_root.names), {}};
  comm.broadcast(shared.constants);
  return shared;
}

SolvedMesh spread_solved(const Communicator& comm, const LoadedMesh& whole, TreeRecord tree) {
  const MeshOrder order = order_of_file(whole.mesh);
  const Solution of_whole = whole.solution.value_or(Solution{});
  SolvedMesh solved{
      scatter_mesh(comm, whole.mesh, order), std::move(tree), share_solution(comm, of_whole), {}};
  Solution& solution = solved.solution;
  const std::size_t width = solution.names.size(), rows = whole.mesh.points.size();
  solution.values.resize(static_cast<std::size_t>(solved.mesh.owned_nodes) * width);
  for (std::size_t column = 0; column < width; ++column) {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows; ++row) values.push_back(of_whole.values[row * width + column]);
    const std::vector<double> own = scatter_nodes(comm, values, order);
    for (std::size_t row = 0; row < own.size(); ++row) solution.values[row * width + column] = own[row];
  }
  return solved;
}

CarriedMesh carry_over(const Communicator& comm, const MeshInput& input, const AdaptationPlan& plan,
                       const SolvedMesh& old) {
  CarriedMesh carried;
  carried.generated = generate_mesh(comm, input, DemandedSplits(comm, plan.demands));
  carried.times.append(carried.generated.times);
  carried.times.begin("transfer");
  carried.start = {old.solution.constants, old.solution.names, {}};
  const auto& names = carried.start.names;
  Transferred transferred = transfer(comm, old.mesh, old.solution.values, static_cast<int>(names.size()),
                                     carried.generated.result.mesh);
  carried.start.values = std::move(transferred.values);
  carried.outside = transferred.report.outside;
  for (std::size_t i = 0; i < names.size(); ++i)
    carried.drift.emplace_back(names[i], transferred.report.drift[i]);
  carried.times.end();
  return carried;
}

AdaptationPlan standing_plan(const TreeRecord& tree, const MeshInput& input) {
  AdaptationPlan plan;
  plan.demands = standing_splits(tree, input);
  return plan;
}

}  // namespace quadloop
