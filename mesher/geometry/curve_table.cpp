#include "mesher/geometry/curve_table.hpp"

#include "mesher/base/ids.hpp"
#include "mesher/base/parallel/node_memory.hpp"

namespace quadloop {

CurveTable::CurveTable(std::span<const Curve> curves) {
  std::vector<Row> rows;
  std::vector<Point> inner;
  std::vector<double> weights;
  rows.reserve(curves.size() + 1);
  for (const Curve& curve : curves) {
    rows.push_back({size32(inner), size32(weights), curve.spacing, curve.interpolates ? 1 : 0});
    inner.insert(inner.end(), curve.inner.begin(), curve.inner.end());
    weights.insert(weights.end(), curve.weights.begin(), curve.weights.end());
  }
  rows.push_back({size32(inner), size32(weights)});
  rows_ = std::move(rows);
  inner_ = std::move(inner);
  weights_ = std::move(weights);
}

Curve CurveTable::operator[](std::int32_t segment) const {
  const Row &row = rows_[segment], &next = rows_[segment + 1];
  const std::span<const Point> inner = inner_of(segment);
  return {{inner.begin(), inner.end()},
          {weights_.begin() + row.weights, weights_.begin() + next.weights},
          row.spacing,
          row.interpolates != 0};
}

CurveTable CurveTable::once_per_node(const NodeMemory& memory) const {
  CurveTable table;
  table.rows_ = memory.once_per_node(rows_);
  table.inner_ = memory.once_per_node(inner_);
  table.weights_ = memory.once_per_node(weights_);
  return table;
}

}  // namespace quadloop
