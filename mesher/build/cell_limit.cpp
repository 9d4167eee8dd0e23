// Checks whether a mesh is within the limits and, if not, finds the settings responsible.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/build/cell_demands.hpp"
#include "mesher/build/mesh_estimate.hpp"

namespace quadloop {

namespace {

constexpr std::size_t most_named = 3;
constexpr double share_that_fits = 0.8;  // fraction of the limit, as the estimate is from a sample

/// Rounds up to two digits.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::ceil(value / unit * (1 - 1e-9)) * unit;
}

/// Changes settings one after another until the mesh fits.
class Relaxation {
 public:
  Relaxation(const MeshLimit& limit, const Geometry& geometry, const MeshOptions& options,
             const DemandedSplits& demanded)
      : limit_{limit}, geometry_{geometry}, type_{options.type}, demanded_{demanded} {
    settings_.size = options.size;
    settings_.boundaries = {geometry.boundaries().begin(), geometry.boundaries().end()};
  }

  /// Returns "spacing.max = 1e-06 asks for most of them" if without this setting less than half of the limit
  /// would be used; else empty.
  std::string cause() const {
    std::vector<CellDemand> demands = cell_demands(settings_, geometry_);
    const auto first = cause_among(demands);
    SizeSettings without = settings_;
    first->lift(without);
    return share_with(without) < 0.5 ? text_of(*first) : "";
  }

  /// Returns "spacing.max = 1e-06 asks for most of them: 0.01 fits".
  std::string cure() {
    std::vector<CellDemand> demands = cell_demands(settings_, geometry_);
    std::string with;
    const auto first = cause_among(demands);
    const std::string cause = text_of(*first);
    const double value = loosen(demands, first);
    for (std::size_t named = 1; !fits(settings_); ++named) {
      if (named == most_named || demands.empty()) return cause + ", and other settings cause too many as well";
      const auto next = cause_among(demands);
      const std::string key = next->key;
      const double before = next->value;
      with += fmt::format(", with {} = {:g} instead of {:g}", key, loosen(demands, next), before);
    }
    return fmt::format("{}: {:g} fits{}", cause, value, with);
  }

 private:
  double share_with(const SizeSettings& settings) const {
    const Geometry geometry = with_boundaries(geometry_, settings.boundaries);
    SizedDomain domain(geometry, settings.size, demanded_);
    const LeafEstimate leaves = estimate_leaves(domain.sizes);
    return share_of(limit_, estimate_mesh(geometry, type_, domain, leaves));
  }
  bool fits(const SizeSettings& settings) const { return share_with(settings) <= share_that_fits; }

  /// Changes the setting and removes it from the demands.
  double loosen(std::vector<CellDemand>& demands, std::vector<CellDemand>::iterator demand) {
    const double value = loosened(*demand);
    demand->set(settings_, value);
    demands.erase(demand);
    return value;
  }

  /// Returns the setting without which the mesh would be smallest.
  std::vector<CellDemand>::iterator cause_among(std::vector<CellDemand>& demands) const {
    auto cause = demands.begin();
    double least = MeshLimit::none;
    for (auto demand = demands.begin(); demand != demands.end(); ++demand) {
      SizeSettings without = settings_;
      demand->lift(without);
      const double left = share_with(without);
      if (left >= least) continue;
      least = left;
      cause = demand;
    }
    return cause;
  }

  static std::string text_of(const CellDemand& demand) {
    return fmt::format("{} = {:g} causes most of them", demand.key, demand.value);
  }

  static double loosened_by(const CellDemand& demand, int halvings) {
    if (!demand.is_size) return demand.value / std::ldexp(1.0, halvings);
    return std::min(rounded_up(demand.value * std::ldexp(1.0, halvings)), demand.loosest);
  }

  /// Returns the value closest to the current one, in factors of two, for which the mesh fits; the loosest if
  /// there is none.
  double loosened(const CellDemand& demand) const {
    constexpr int most = 40;
    int low = 0, high = 1;
    while (high < most && loosened_by(demand, high) < demand.loosest) ++high;
    const auto fits_at = [&](int halvings) {
      SizeSettings changed = settings_;
      demand.set(changed, loosened_by(demand, halvings));
      return fits(changed);
    };
    if (!fits_at(high)) return loosened_by(demand, high);
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (fits_at(middle) ? high : low) = middle;
    }
    return loosened_by(demand, high);
  }

  const MeshLimit& limit_;
  const Geometry& geometry_;
  MeshType type_;
  const DemandedSplits& demanded_;
  SizeSettings settings_;
};

/// Returns the settings to change.
std::string cure_for(const MeshEstimate& estimate, const Geometry& geometry, const MeshOptions& options,
                     const DemandedSplits& demanded) {
  const MeshLimit& limit = options.limit;
  const DemandedSplits none;
  if (demanded.empty() && 2 * estimate.layer_cells > estimate.cells)
    return fmt::format(
        "{} of them are in layers: use fewer layers, or thicker ones with a larger growth, as columns are at "
        "most as wide as their last two layers are high",
        text_of_cells(estimate.layer_cells));
  if (!demanded.empty()) {
    SizedDomain domain(geometry, options.size, none);
    const LeafEstimate leaves = estimate_leaves(domain.sizes);
    const bool fits =
        share_of(limit, estimate_mesh(geometry, options.type, domain, leaves)) <= share_that_fits;
    if (fits && demanded.for_layers())
      return "the layers require smaller cells at their outer edge than the case has, and these are too "
             "many: "
             "use fewer or thinner layers";
    if (fits)
      return "the refinement by adaptation is the cause: reduce adapt.max_nodes, or increase adapt.min or "
             "adapt.refine";
  }
  return Relaxation(limit, geometry, options, none).cure();
}

}  // namespace

std::string cause_of_cells(const MeshEstimate& estimate, const Geometry& geometry,
                           const MeshOptions& options) {
  if (2 * estimate.layer_cells > estimate.cells) return "most of them in layers";
  MeshLimit all;
  all.cells = estimate.cells;
  return Relaxation(all, geometry, options, DemandedSplits{}).cause();
}

void require_within(const MeshEstimate& estimate, const Geometry& geometry, const MeshOptions& options,
                    const DemandedSplits& demanded) {
  const MeshLimit& limit = options.limit;
  if (share_of(limit, estimate) <= 1) return;
  const bool by_memory = estimate.cells <= limit.cells;
  const std::string allowed = by_memory ? fmt::format("{} are free", text_of_bytes(limit.bytes))
                                        : fmt::format("--max-cells allows {:.0f}", limit.cells);
  const std::string or_else =
      by_memory
          ? fmt::format("use more machines, or override the memory check with --max-cells {}",
                        text_of_cells(rounded_up(1.2 * estimate.cells)))
          : fmt::format("allow more with --max-cells {}", text_of_cells(rounded_up(1.2 * estimate.cells)));
  throw TooManyCells(fmt::format("the mesh would have about {} cells, {} of memory, but {}; {}; or {}",
                                 text_of_cells(estimate.cells),
                                 text_of_bytes(total_bytes(estimate, limit.ranks)), allowed,
                                 cure_for(estimate, geometry, options, demanded), or_else));
}

}  // namespace quadloop
