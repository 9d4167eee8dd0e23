#include "quadloop/case/adapt_settings.hpp"

namespace quadloop {

using adapt::AdaptOptions;

namespace {

/// Reads a name, a list of names, { size = "h" } or { error = "e" }.
SensorFields read_sensor_fields(const io::CaseTable& table, const std::string& key) {
  using enum AdaptOptions::Source;
  if (!table.is_table(key)) {
    const std::vector<std::string> names = table.texts(key);
    if (names.empty())
      table.refuse(key, "is empty; name what the marks are made from, as in variable = \"density\"");
    return {variables, names};
  }
  const io::CaseTable field = *table.table(key);
  refuse_unknown_keys(field, {"size", "error"});
  const auto size_name = field.text("size"), error_name = field.text("error");
  if (size_name.has_value() == error_name.has_value())
    table.refuse(key, "must be a name, a list of names, { size = \"name\" } or { error = \"name\" }");
  return size_name ? SensorFields{size, {*size_name}} : SensorFields{error, {*error_name}};
}

ValueForm<SensorFields> sensor_fields() {
  return {"text, a list, or a table", "\"pressure\"", read_sensor_fields};
}

ValueForm<UntilKeys> until() {
  return {"table", "{ cl = 1e-3 }", [](const io::CaseTable& table, const std::string& key) {
            UntilKeys changes;
            until_keys().read(*table.table(key), changes);
            if (changes == UntilKeys{})
              table.refuse(key, "is empty; give changes of a cycle, as in until = { cl = 1e-3, cd = 1e-4 }");
            return changes;
          }};
}

/// These keys have other defaults and limits if they are fractions of the quadtree cells.
void read_thresholds(const io::CaseTable& table, AdaptOptions& options) {
  const bool shares = options.threshold == AdaptOptions::Threshold::fraction;
  if (shares) {
    options.refine = table.number("refine", {0, 1}).value_or(adapt::FractionRule{}.refine);
    options.coarsen = table.number("coarsen", {0, 1}).value_or(adapt::FractionRule{}.coarsen);
    if (options.refine + options.coarsen > 1)
      table.refuse("coarsen", "with refine must be 1 at most: they are shares of the same leaves");
  } else if (-options.coarsen > options.refine) {
    table.refuse("coarsen", "lets leaves be refined and coarsened at once; make it larger than -refine");
  }
}

/// Options of adaptation by a target size field instead of refinement flags.
void take_norm(const io::CaseTable& table, AdaptOptions& options) {
  if (!options.norm) return;
  if (options.source == AdaptOptions::Source::size)
    table.refuse("norm", "makes sizes from variables or an error; name these in variable, or leave norm out");
  if (table.has("indicator") && options.indicator != adapt::Indicator::hessian)
    table.refuse("indicator", "must be \"hessian\" with norm, or left out");
  if (table.has("threshold") && options.threshold != AdaptOptions::Threshold::nodes)
    table.refuse("threshold", "must be \"nodes\" with norm, or left out");
  options.indicator = adapt::Indicator::hessian;
  options.threshold = AdaptOptions::Threshold::nodes;
}

}  // namespace

const KeyTable<UntilKeys>& until_keys() {
  static const KeyTable<UntilKeys> keys{
      "adapt.until",
      {key<&UntilKeys::cl>("cl", number(io::Range::positive()), "Change of the lift coefficient.",
                           {.fallback = "none"}),
       key<&UntilKeys::cd>("cd", number(io::Range::positive()), "Change of the drag coefficient.",
                           {.fallback = "none"}),
       key<&UntilKeys::estimate>("estimate", number(io::Range::positive()),
                                 "Change of the estimated error, relative to the cycle before.",
                                 {.fallback = "none", .needs = {{"adapt.norm"}}})}};
  return keys;
}

const KeyTable<AdaptKeys>& adapt_keys() {
  const std::string follow = "sizes follow from max_nodes; leave it out";
  static const KeyTable<AdaptKeys> keys{
      "adapt",
      {key<&AdaptKeys::options, &AdaptOptions::cycles>(
           "cycles", whole({0, 10000}),
           "Number of adaptation cycles after the initial solution. The run ends earlier if a cycle flags no "
           "cell. `--cycles` overrides it."),
       key<&AdaptKeys::options, &AdaptOptions::passes>(
           "passes", whole({0, 100}),
           "Number of [initial adaptation passes](../explanation/adaptation.md#initial-passes) on partly "
           "converged flows before cycle 0.",
           {.needs = {{"solver.kind = \"euler\"", "the built-in solver alone can end flows early",
                       "passes > 0"},
                      {"solver.time = \"steady\"", "a steady flow can be ended early", "passes > 0"}}}),
       key<&AdaptKeys::fields>("variable", sensor_fields(),
                               "Sensor variables, or `{ size = \"h\" }` for a size field or `{ error = \"e\" "
                               "}` for an error estimate, written by the solver.",
                               {.fallback = "`\"density\"`"}),
       key<&AdaptKeys::options, &AdaptOptions::indicator>(
           "indicator", choice(adapt::indicator_words),
           "[Indicator](../explanation/adaptation.md) of the cells to refine."),
       key<&AdaptKeys::options, &AdaptOptions::threshold>(
           "threshold", choice(AdaptOptions::threshold_words),
           "Rule that selects the cells: a `deviation` above the mean, a `fraction` of the cells, or the "
           "number of `nodes` to reach.",
           {.needs = {{"max_nodes", "it is the number of nodes to reach", "threshold = \"nodes\""}}}),
       key<&AdaptKeys::options, &AdaptOptions::refine>(
           "refine", number({-100, 100}),
           "Refine above this number of standard deviations over the mean; with `threshold = \"fraction\"`, "
           "fraction of the cells, 0 to 1 (default 0.2).",
           {.example = "2", .needs = {{"no norm", follow}}}),
       key<&AdaptKeys::options, &AdaptOptions::coarsen>(
           "coarsen", number({-100, 100}),
           "Coarsen below this number of standard deviations under the mean; with `threshold = "
           "\"fraction\"`, fraction of the cells (default 0.1).",
           {.example = "2", .needs = {{"no norm", follow}}}),
       key<&AdaptKeys::options, &AdaptOptions::max_nodes>(
           "max_nodes", whole({1, 1e12}),
           "Largest number of nodes, those of layers included. With `threshold = \"nodes\"` the mesh gets 95 "
           "to 100 % of it.",
           {.fallback = "none"}),
       key<&AdaptKeys::options, &AdaptOptions::norm>(
           "norm", number({1, 100}),
           "Exponent p: cells get the [sizes](../explanation/adaptation.md#target-size-field) that minimise "
           "the L^p norm of the interpolation error.",
           {.fallback = "none",
            .needs = {{"max_nodes", "the number of nodes for which the error is to be least"}}}),
       key<&AdaptKeys::options, &AdaptOptions::growth>(
           "growth", number({1, 1000, true, false}),
           "Largest ratio of the numbers of nodes of successive meshes.",
           {.fallback = "none", .needs = {{"norm", "it bounds the nodes of wanted sizes"}}}),
       key<&AdaptKeys::until>("until", until(),
                              "End the run when the changes between cycles are below these ([stopping "
                              "criteria](../explanation/adaptation.md#stopping-criteria)).",
                              {.fallback = "none"}),
       key<&AdaptKeys::options, &AdaptOptions::min>("min", number(io::Range::positive()),
                                                    "Smallest cell size of adaptation.",
                                                    {.unit = "length", .fallback = "`spacing.min`"}),
       key<&AdaptKeys::options, &AdaptOptions::facets>("facets", flag(),
                                                       "Let cells at the points of a polygonal boundary "
                                                       "become smaller than half of the adjacent segments."),
       key<&AdaptKeys::options, &AdaptOptions::transfer>(
           "transfer", choice(adapt::transfer_words),
           "Transfer of node values; cell values are always transferred "
           "[conservatively](../explanation/adaptation.md#solution-transfer).")}};
  return keys;
}

std::optional<AdaptOptions> read_adapt_table(const io::CaseTable& root) {
  const auto table = root.table("adapt");
  if (!table) return {};
  AdaptKeys keys;
  adapt_keys().read(*table, keys);
  keys.options.source = keys.fields.source;
  keys.options.variables = keys.fields.names;
  keys.options.until = {keys.until.cl, keys.until.cd, keys.until.estimate};
  take_norm(*table, keys.options);
  if (!keys.options.norm) read_thresholds(*table, keys.options);
  return keys.options;
}

}  // namespace quadloop
