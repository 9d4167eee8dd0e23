#include "quadloop/case/smooth_settings.hpp"

#include <cmath>

namespace quadloop {

namespace {

/// Whether cells are to follow the solution, and how far.
void read_targets(const CaseTable& table, Settings& settings) {
  constexpr double usual_stretch = 8;
  const auto stretch = table.number("stretch", {1, 100, true, false});
  if (table.choice("targets", {"ideal", "solution"}) != "solution") {
    if (stretch)
      table.refuse("stretch", "bounds how thin cells get at fronts; it needs targets = \"solution\"");
    return;
  }
  settings.stretch = stretch.value_or(usual_stretch);
  if (settings.mesh.type == MeshType::metric)
    table.refuse("targets",
                 "does nothing with mesh.type = \"metric\", whose cells follow the solution; leave it out");
  if (settings.mesh.quads == QuadChoice::parallel)
    table.refuse("targets",
                 "leaves few parallelograms, which mesh.quads = \"parallel\" wants; take "
                 "mesh.type = \"delaunay\" in its place");
  if (settings.smooth.sweeps == 0)
    table.refuse("targets", "moves nodes, and sweeps = 0 moves none; leave one of them out");
}

}  // namespace

void read_smooth_table(const CaseTable& root, Settings& settings) {
  const auto table = root.table("smooth");
  if (!table) return;
  if (const auto sweeps = table->number("sweeps", {0, 100000})) {
    if (*sweeps != std::floor(*sweeps))
      table->refuse("sweeps", "must be a whole number, 0 or more; 0 leaves the mesh as it is cut");
    settings.smooth.sweeps = static_cast<int>(*sweeps);
  }
  if (const auto word = table->choice("objective", words_of(objective_words)))
    settings.smooth.objective = *value_of(objective_words, *word);
  if (const auto word = table->choice("method", words_of(method_words)))
    settings.smooth.method = *value_of(method_words, *word);
  read_targets(*table, settings);
  table->finish();
}

void require_variables_of_targets(const CaseTable& root, const Settings& settings) {
  if (!settings.stretch || !settings.adapt || settings.adapt->source == AdaptOptions::Source::variables)
    return;
  root.table("smooth")->refuse("targets",
                               "follows variables, and adapt.variable names a size or an error; name "
                               "variables there, or leave targets out");
}

}  // namespace quadloop
