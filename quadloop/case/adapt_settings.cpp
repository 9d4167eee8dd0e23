#include "quadloop/case/adapt_settings.hpp"

#include <cmath>

namespace quadloop {

namespace {

/// A name, a list of names, { size = "h" } or { error = "e" }.
void read_variable(const CaseTable& table, AdaptOptions& options) {
  if (!table.has("variable")) return;
  if (!table.is_table("variable")) {
    options.variables = table.texts("variable");
    if (options.variables.empty())
      table.refuse("variable", "is empty; name what the marks are made from, as in variable = \"density\"");
    return;
  }
  const CaseTable field = *table.table("variable");
  const auto size = field.text("size"), error = field.text("error");
  field.finish();
  if (size.has_value() == error.has_value())
    table.refuse("variable", "must be a name, a list of names, { size = \"name\" } or { error = \"name\" }");
  options.source = size ? AdaptOptions::Source::size : AdaptOptions::Source::error;
  options.variables = {size ? *size : *error};
}

void read_thresholds(const CaseTable& table, AdaptOptions& options) {
  if (const auto word = table.choice("threshold", words_of(AdaptOptions::threshold_words)))
    options.threshold = *value_of(AdaptOptions::threshold_words, *word);
  const bool shares = options.threshold == AdaptOptions::Threshold::fraction;
  if (shares) {
    options.refine = FractionRule{}.refine;
    options.coarsen = FractionRule{}.coarsen;
  }
  const Range range = shares ? Range{0, 1} : Range{-100, 100};
  options.refine = table.number("refine", range).value_or(options.refine);
  options.coarsen = table.number("coarsen", range).value_or(options.coarsen);
  if (shares && options.refine + options.coarsen > 1) {
    table.refuse("coarsen", "with refine must be 1 at most: they are shares of the same leaves");
  }
  if (!shares && -options.coarsen > options.refine)
    table.refuse("coarsen", "lets leaves be refined and coarsened at once; make it larger than -refine");
}

/// Wanted sizes instead of marks.
void read_norm(const CaseTable& table, AdaptOptions& options) {
  options.norm = table.number("norm", {1, 100});
  options.growth = table.number("growth", {1, 1000, true, false});
  if (!options.norm) {
    if (options.growth) table.refuse("growth", "bounds the nodes of wanted sizes; it needs norm");
    return;
  }
  if (options.source == AdaptOptions::Source::size)
    table.refuse("norm", "makes sizes from variables or an error; name these in variable, or leave norm out");
  if (table.has("indicator") && options.indicator != Indicator::hessian)
    table.refuse("indicator", "must be \"hessian\" with norm, or left out");
  if (table.has("threshold") && options.threshold != AdaptOptions::Threshold::nodes)
    table.refuse("threshold", "must be \"nodes\" with norm, or left out");
  for (const char* key : {"refine", "coarsen"}) {
    if (table.has(key))
      table.refuse(key, "does nothing with norm: sizes follow from max_nodes; leave it out");
  }
  options.indicator = Indicator::hessian;
  options.threshold = AdaptOptions::Threshold::nodes;
  if (!options.max_nodes)
    table.refuse("norm", "needs max_nodes: the number of nodes for which the error is to be least");
}

void read_until(const CaseTable& table, AdaptOptions& options) {
  const auto until = table.table("until");
  if (!until) return;
  options.until = {until->number("cl", Range::positive()), until->number("cd", Range::positive()),
                   until->number("estimate", Range::positive())};
  until->finish();
  if (options.until.empty())
    table.refuse("until", "is empty; give changes of a cycle, as in until = { cl = 1e-3, cd = 1e-4 }");
  if (options.until.estimate && !options.norm) table.refuse("until", "names the estimate, which needs norm");
}

}  // namespace

std::optional<AdaptOptions> read_adapt_table(const CaseTable& root) {
  const auto table = root.table("adapt");
  if (!table) return {};
  AdaptOptions options;
  if (const auto cycles = table->number("cycles", {0, 10000})) {
    if (*cycles != std::floor(*cycles))
      table->refuse("cycles", "must be a whole number: how many times the mesh is adapted");
    options.cycles = static_cast<int>(*cycles);
  }
  if (const auto passes = table->number("passes", {0, 100})) {
    if (*passes != std::floor(*passes))
      table->refuse("passes", "must be a whole number: how many meshes are solved roughly before cycle 0");
    options.passes = static_cast<int>(*passes);
  }
  read_variable(*table, options);
  if (const auto word = table->choice("indicator", words_of(indicator_words)))
    options.indicator = *value_of(indicator_words, *word);
  read_thresholds(*table, options);
  if (const auto nodes = table->number("max_nodes", {1, 1e12})) {
    if (*nodes != std::floor(*nodes)) table->refuse("max_nodes", "must be a whole number of nodes");
    options.max_nodes = static_cast<std::int64_t>(*nodes);
  }
  read_norm(*table, options);
  read_until(*table, options);
  if (options.threshold == AdaptOptions::Threshold::nodes && !options.max_nodes) {
    table->refuse("threshold", "is \"nodes\", but max_nodes is missing: it is the number to be met");
  }
  options.min = table->number("min", Range::positive());
  options.facets = table->flag("facets");
  if (const auto word = table->choice("transfer", words_of(transfer_words)))
    options.transfer = *value_of(transfer_words, *word);
  table->finish();
  return options;
}

}  // namespace quadloop
