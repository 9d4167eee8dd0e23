#include "quadloop/quadloop.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/adjoint/estimate_goals.hpp"
#include "flow/euler/euler_solver.hpp"
#include "io/mesh_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/surely_valid.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/reorder_mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/case_parts.hpp"
#include "quadloop/require_input.hpp"
#include "smoother/keep_layers.hpp"
#include "smoother/smooth_mesh.hpp"

namespace quadloop {

namespace {

std::string text_of(const MeshFault& fault) {
  return fmt::format("{}: {} at ({}, {})", name_of(fault.rule), fault.what, fault.place.x, fault.place.y);
}

/// Whether all triangles of the mesh are Delaunay. Gathers the mesh on the root. *Collective.*
bool all_delaunay(const Communicator& comm, const Mesh& mesh) {
  const Mesh whole = gather_whole(comm, mesh);
  if (!comm.is_root()) return comm.any(false);
  const Communicator alone(MPI_COMM_SELF);
  return comm.any(
      is_delaunay(whole, smoother::blocks_for_flips(alone, whole, layer_places(alone, whole), {})));
}

}  // namespace

void require_rows(const Communicator& comm, const Mesh& mesh, const Field& field) {
  comm.together([&] {
    if (field.values.size() == field.width() * mesh.owned_nodes) return;
    throw InputError(fmt::format("the field has {} values on rank {}, but {} variables at {} nodes",
                                 field.values.size(), comm.rank(), field.width(), mesh.owned_nodes));
  });
  const std::size_t cells = mesh.cell_count();
  comm.together([&] {
    if (field.cells.values.size() == field.cells.width() * cells) return;
    throw InputError(fmt::format("the field has {} cell values on rank {}, but {} variables in {} cells",
                                 field.cells.values.size(), comm.rank(), field.cells.width(), cells));
  });
}

progress::Observer observer_of(const ProgressCallback& callback, const std::function<int()>& cycle) {
  if (!callback) return {};
  return [&callback, cycle](const std::string& stage, double share) {
    if (!callback({stage, share, cycle ? cycle() : -1}))
      throw Cancelled("the progress callback returned false");
  };
}

Case::Case(const Communicator& comm, const CaseSource& source, const std::vector<std::string>& assignments) {
  auto parts = std::make_shared<CaseParts>(CaseParts{{}, {source, assignments, {}, {}}, {}});
  parts->input = load_case(comm, parts->arguments, parts->warnings);
  parts->input.mesh->mesh.limit = mesh_limit(comm, {});
  parts_ = std::move(parts);
}

const std::string& Case::title() const { return parts_->input.settings.title; }

int Case::cycles() const {
  const auto& adapt = parts_->input.settings.adapt;
  return adapt ? adapt->cycles : 0;
}

const std::vector<std::string>& Case::warnings() const { return parts_->warnings; }

NewMesh make_mesh(const Communicator& comm, const Case& of, const ProgressCallback& progress) {
  const progress::Observed observed(comm, observer_of(progress));
  GeneratedMesh generated = generate_mesh(comm, mesh_input(of));
  MeshResult& made = generated.result;
  return {{std::move(made.mesh), std::move(made.tree), {}, {}},
          {},
          std::move(made.report.warnings),
          std::move(generated.layers)};
}

void smooth(const Communicator& comm, const Case& of, Mesh& mesh, const ProgressCallback& progress) {
  const progress::Observed observed(comm, observer_of(progress));
  const MeshInput& input = mesh_input(of);
  const TreeGrid grid = input.grid();
  smoother::SmoothOptions options = smooth_options_for(input, grid.finest_level(input.mesh.size.min));
  if (options.delaunay && !all_delaunay(comm, mesh)) options.delaunay = nullptr;
  smoother::keep_layers(comm, mesh, options);
  smoother::smooth_mesh(comm, mesh, options);
}

FlowSolver built_in_solver(const Communicator& comm, const Case& of) {
  const CaseInput& input = of.parts().input;
  const std::string& path = path_of(of);
  std::optional<adapt::ChosenSolver> chosen;
  comm.together([&] {
    chosen = chosen_solver(input.settings.solver, input.settings.outline.rules, input.mesh->geometry, path);
    if (!std::holds_alternative<flow::EulerOptions>(*chosen))
      throw InputError(path + ": 'solver.kind' is not the built-in solver; set kind = \"euler\"");
  });
  const auto& options = std::get<flow::EulerOptions>(*chosen);
  return flow::euler_solver(options, flow::estimate_goals(options));
}

RefinementFlags::RefinementFlags(const SolvedMesh& of, std::shared_ptr<const adapt::AdaptationPlan> plan)
    : case_digest_{of.tree.attributes.case_digest},
      coordinate_digest_{of.tree.attributes.coordinate_digest},
      plan_{std::move(plan)} {}

std::int64_t RefinementFlags::refined() const { return plan_->refined; }
std::int64_t RefinementFlags::coarsened() const { return plan_->coarsened; }
bool RefinementFlags::changes_mesh() const { return plan_->changes_mesh(); }
const std::vector<std::string>& RefinementFlags::warnings() const { return plan_->warnings; }

RefinementFlags sense(const Communicator& comm, const Case& of, const SolvedMesh& solved) {
  require_rows(comm, solved.mesh, solved.solution);
  const adapt::AdaptOptions& options = adapt_options(of.parts().input.settings, path_of(of));
  auto plan = std::make_shared<const adapt::AdaptationPlan>(
      adapt::plan_adaptation(comm, mesh_input(of), options, solved));
  return {solved, std::move(plan)};
}

NewMesh remesh(const Communicator& comm, const Case& of, const RefinementFlags& flags,
               const SolvedMesh& before, const ProgressCallback& progress) {
  const progress::Observed observed(comm, observer_of(progress));
  require_rows(comm, before.mesh, before.solution);
  const TreeAttributes& tree = before.tree.attributes;
  comm.together([&] {
    if (flags.case_digest_ != tree.case_digest || flags.coordinate_digest_ != tree.coordinate_digest)
      throw InputError("the flags belong to another mesh than the one to be changed; call sense() again");
  });
  adapt::RemeshedSolution remeshed = adapt::remesh_and_transfer(comm, mesh_input(of), *flags.plan_, before);
  MeshResult& made = remeshed.generated.result;
  return {{std::move(made.mesh), std::move(made.tree), std::move(remeshed.start), {}},
          std::move(remeshed.report),
          std::move(made.report.warnings),
          std::move(remeshed.generated.layers)};
}

std::vector<std::string> check(const Communicator& comm, const Mesh& mesh) {
  if (std::ranges::none_of(mesh.boundaries, &BoundaryEdges::inner_line) && is_surely_valid(comm, mesh))
    return {};
  const Mesh whole = gather_whole(comm, mesh);
  std::vector<std::string> faults;
  if (comm.is_root()) {
    for (const MeshFault& fault : validate(whole, cell_blocks(whole))) faults.push_back(text_of(fault));
  }
  return broadcast_words(comm, faults);
}

MeshFile read(const Communicator& comm, const std::string& path) {
  io::LoadedMesh loaded = io::read_mesh(comm, path);
  io::list_inner_curves(loaded);
  const ReorderedMesh reordered(comm, loaded.mesh, order_for_parts(comm, loaded.mesh));
  MeshFile file{reordered.mesh(loaded.mesh), reordered.field(loaded.solution.value_or(Field{})),
                loaded.warnings};
  file.mesh.blocks = reordered.blocks(loaded.mesh.blocks);
  return file;
}

std::vector<std::string> write(const Communicator& comm, const Mesh& mesh, const std::string& path,
                               const Field& field) {
  io::require_writable_suffix(path);
  require_rows(comm, mesh, field);
  io::OutputSet outputs(comm);
  const Field* solution = !field.empty() ? &field : nullptr;
  io::write_mesh(outputs, mesh, path, solution);
  outputs.commit();
  return io::losses_in(mesh, solution, path);
}

void write_solved(const Communicator& comm, const SolvedMesh& solved, const std::string& stem) {
  require_rows(comm, solved.mesh, solved.solution);
  io::OutputSet outputs(comm);
  io::write_mesh(outputs, solved.mesh, stem + ".mesh", !solved.solution.empty() ? &solved.solution : nullptr);
  io::write_tree(outputs, solved.tree, stem + io::tree_suffix);
  outputs.commit();
}

SolvedMesh read_solved(const Communicator& comm, const Case& of, const std::string& stem) {
  const std::string mesh = stem + ".mesh", tree = stem + io::tree_suffix;
  io::LoadedMesh loaded = io::read_mesh(comm, mesh);
  SolvedMesh solved = adapt::in_tree_order(comm, std::move(loaded.mesh), loaded.solution.value_or(Field{}),
                                           io::read_tree(comm, tree));
  solved.file = mesh;
  const TreeAttributes& made = solved.tree.attributes;
  comm.together([&] {
    if (made.case_digest != mesh_input(of).digest || made.geometry_digest != mesh_input(of).geometry.digest())
      throw InputError(tree + ": belongs to another case than " + path_of(of) + ", or to another geometry");
  });
  adapt::require_own_mesh(comm, solved, mesh, tree);
  return solved;
}

}  // namespace quadloop
