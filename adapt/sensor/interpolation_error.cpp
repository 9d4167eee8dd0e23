#include "adapt/sensor/interpolation_error.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/sensor/recovery/hessians.hpp"
#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/block_part.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

namespace {

/// Mean error and largest second derivative of a cell.
struct CellError {
  double mean = 0, bend = 0;
};

void raise_by_variable(const Communicator& comm, const Mesh& mesh, std::vector<double> values, ValuesAt at,
                       std::vector<CellError>& errors) {
  const ScaledField scaled = scaled_by_range(comm, std::move(values));
  if (scaled.constant) return;  // true on all ranks or on none
  const std::vector<CellHessian> hessians = cell_hessians(comm, mesh, scaled, at);
  std::vector<double> means(hessians.size(), 0);
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    means[cell] += along(hessians[cell].mean, mesh.point(to) - mesh.point(from)) / 24;
  });
  for (std::size_t i = 0; i < means.size(); ++i) {
    errors[i].mean = std::max(errors[i].mean, means[i]);
    errors[i].bend = std::max(errors[i].bend, hessians[i].largest);
  }
}

std::vector<CellError> cell_errors(const Communicator& comm, const Mesh& mesh, const Field& field) {
  std::vector<CellError> errors(mesh.cell_count());
  const Field shared = with_ghosts(comm, mesh, field);
  for (std::size_t i = 0; i < shared.width(); ++i)
    raise_by_variable(comm, mesh, shared.column(i), ValuesAt::nodes, errors);
  for (std::size_t i = 0; i < field.cells.width(); ++i)
    raise_by_variable(comm, mesh, field.cells.column(i), ValuesAt::cells, errors);
  return errors;
}

}  // namespace

InterpolationError interpolation_error(const Communicator& comm, const Mesh& mesh, const Field& field) {
  check_field(comm, mesh, field, FieldSign::any);
  InterpolationError error;
  for (const CellShape& shape : cell_shapes(mesh)) error.areas.push_back(shape.area);
  const std::vector<CellError> errors = cells_by_block<CellError>(
      comm, mesh, field,
      [&](const Mesh& part, const Field& of_part) { return cell_errors(comm, part, of_part); });
  for (const CellError& of_cell : errors) {
    error.mean.push_back(of_cell.mean);
    error.bends.push_back(of_cell.bend);
  }
  return error;
}

double norm_of(const Communicator& comm, const InterpolationError& error, double p) {
  std::vector<double> terms;
  for (std::size_t i = 0; i < error.mean.size(); ++i)
    terms.push_back(error.areas[i] * std::pow(error.mean[i], p));
  return std::pow(reproducible_sum(comm, terms), 1 / p);
}

std::vector<double> cell_densities(const InterpolationError& error, double p) {
  std::vector<double> densities;
  densities.reserve(error.bends.size());
  for (const double bend : error.bends) densities.push_back(std::pow(bend, p / (p + 1)));
  return densities;
}

}  // namespace quadloop::adapt
