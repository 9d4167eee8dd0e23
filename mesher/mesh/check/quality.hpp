#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The angle at p between the edges to `next` and to `previous`, in degrees: 0 to 180 where the corner turns
/// left, negative where it is inverted.
double corner_degrees(Point previous, Point p, Point next);

/// 1 for the best shape, 0 for a flat cell, negative for an inverted one. Triangle: 4 sqrt(3) area / sum of
/// squared edges, 1 if equilateral. Quad: the smallest over its corners of twice the corner's J / (|e1|^2 +
/// |e2|^2), 1 if a square.
double quality_of(std::span<const Point> cell);

/// How far a quadrilateral is from a parallelogram: the length of x1 - x2 + x3 - x4 by the square root of its
/// area, which must be positive.
double skew_of(const std::array<Point, 4>& quad);
/// A quadrilateral of no more skew counts as a parallelogram.
inline constexpr double parallel_skew = 0.01;

/// Shapes of all cells over all ranks. Empty meshes have angles and qualities of 0.
struct QualitySummary {
  MeshCounts counts;
  double smallest_degrees = 0, largest_degrees = 0;  ///< of any corner
  double worst = 0, mean = 0;                        ///< quality_of a cell
};

MeshCounts count(const Communicator& comm, const Mesh& mesh);

/// The same bits on any number of ranks: the mean is summed in fixed point (2^-30). *Collective.*
QualitySummary summarise_quality(const Communicator& comm, const Mesh& mesh);

/// Of two cells, the larger area by the smaller; infinite for cells without area.
double area_ratio(double area, double other);

/// Of this rank's cells, triangles first, then quads.
std::vector<double> cell_areas(const Mesh& mesh);

/// The area of this rank's cells.
double area_of(const Mesh& mesh);

}  // namespace quadloop
