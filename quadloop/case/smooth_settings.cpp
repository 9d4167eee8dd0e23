#include "quadloop/case/smooth_settings.hpp"

namespace quadloop {

const KeyTable<SmoothKeys>& smooth_keys() {
  const std::string follows = "targets = \"solution\"";
  static const KeyTable<SmoothKeys> keys{
      "smooth",
      {key<&SmoothKeys::options, &smoother::SmoothOptions::sweeps>(
           "sweeps", whole({0, 100000}), "Largest number of visits to each node; 0 disables smoothing."),
       key<&SmoothKeys::options, &smoother::SmoothOptions::objective>(
           "objective", choice(smoother::objective_words),
           "Objective function around each node: `power`, or `thesis` for Eq. 3.4; see "
           "[smoothing](../explanation/smoothing.md)."),
       key<&SmoothKeys::options, &smoother::SmoothOptions::method>("method", choice(smoother::method_words),
                                                                   "Optimisation method."),
       key<&SmoothKeys::follows_solution>(
           "targets", choice<bool>({{"ideal", false}, {"solution", true}}),
           "Target shapes: squares and equilateral triangles, or thin cells where `adapt.variable` has a "
           "large curvature ([r-adaptation](../explanation/adaptation.md#r-adaptation)).",
           {.needs = {{"mesh.type = \"hybrid\" or mesh.type = \"delaunay\"",
                       "cells of a metric follow the solution anyway", follows},
                      {"mesh.quads = \"all\"",
                       "few parallelograms are left; take mesh.type = \"delaunay\" in the place of quads",
                       follows},
                      {"sweeps > 0", "nodes are moved by sweeps", follows}}}),
       key<&SmoothKeys::stretch>(
           "stretch", number({1, 100, true, false}),
           "Largest aspect ratio created by node movement, relative to the quadtree cell.",
           {.needs = {{follows}}})}};
  return keys;
}

void read_smooth_table(const io::CaseTable& table, Settings& settings) {
  SmoothKeys keys;
  smooth_keys().read(table, keys);
  settings.smooth = keys.options;
  if (keys.follows_solution) settings.stretch = keys.stretch;
}

void require_variables_of_targets(const io::CaseTable& root, const Settings& settings) {
  if (!settings.stretch || !settings.adapt ||
      settings.adapt->source == adapt::AdaptOptions::Source::variables)
    return;
  root.table("smooth")->refuse("targets",
                               "follows variables, and adapt.variable names a size or an error; name "
                               "variables there, or leave targets out");
}

}  // namespace quadloop
