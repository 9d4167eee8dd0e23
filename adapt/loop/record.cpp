#include "adapt/loop/record.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

namespace quadloop::adapt {

namespace {

using Json = nlohmann::ordered_json;

JsonObject object(const std::vector<std::pair<std::string, double>>& members) {
  JsonObject json;
  for (const auto& [name, value] : members) json.add(name, value);
  return json;
}

JsonObject record_of(const PassRecord& pass) {
  JsonObject json;
  json.add("nodes", pass.nodes);
  for (const auto& [name, value] : {std::pair{"cl", pass.cl}, {"cd", pass.cd}, {"residual", pass.residual}}) {
    if (value) json.add(name, *value);
  }
  return json;
}

/// Parses a text; an empty object if it is not a JSON object.
Json parsed(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_object() ? json : Json::object();
}

std::optional<std::uint64_t> digest_in(const Json& json, const std::string& name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_string()) return {};
  const auto& text = found->get_ref<const std::string&>();
  std::uint64_t digest = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), digest, 16);
  if (fault != std::errc{} || text.size() != 16 || end != text.data() + text.size()) return {};
  return digest;
}

/// Returns a value on one line; lists are formatted as in a case's settings.
std::string one_line(const Json& value) {
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ", ") + one_line(part);
  return "[" + text + "]";
}

CaseSettings settings_in(const Json& json) {
  CaseSettings settings;
  const auto found = json.find("case");
  if (found == json.end() || !found->is_object()) return settings;
  for (const auto& [key, value] : found->items()) settings.emplace_back(key, one_line(value));
  return settings;
}

}  // namespace

JsonObject statistics_of(const CycleRecord& record) {
  JsonObject json;
  json.add("cycle", record.cycle);
  json.add("case_digest", fmt::format("{:016x}", record.case_digest));
  json.add("geometry_digest", fmt::format("{:016x}", record.geometry_digest));
  if (record.template_digest != 0)
    json.add("template_digest", fmt::format("{:016x}", record.template_digest));
  json.add("solution_digest", fmt::format("{:016x}", record.solution_digest));
  json.add("nodes", record.nodes);
  json.add("triangles", record.triangles);
  json.add("quads", record.quads);
  json.add("leaves", record.leaves);
  json.add("worst_angle", record.worst_angle);
  if (record.layered) {
    json.add("outer_min_angle", record.layered->outer_angle);
    json.add("layer_aspect_ratio", record.layered->aspect_ratio);
    json.add("layer_non_orthogonality", record.layered->non_orthogonality);
    json.add("layer_skewness", record.layered->skewness);
  }
  json.add("indicator", object({{"mean", record.mean}, {"deviation", record.deviation}}));
  json.add("refined", record.refined);
  json.add("coarsened", record.coarsened);
  if (record.morphed) json.add("morphed", *record.morphed);
  std::vector<JsonObject> passes;
  for (const PassRecord& pass : record.passes) passes.push_back(record_of(pass));
  if (!passes.empty()) json.add("passes", passes);
  json.add("outside", record.outside);
  json.add("drift", object(record.drift));
  for (const auto& [name, value] : {std::pair{"cl", record.cl},
                                    {"cd", record.cd},
                                    {"residual", record.residual},
                                    {"log_residual", record.log_residual},
                                    {"estimate", record.estimate},
                                    {"order", record.order}}) {
    if (value) json.add(name, *value);
  }
  if (record.converged) json.add("converged", *record.converged);
  if (record.unsteady) json.add("unsteady", record_of(*record.unsteady));
  if (record.settled) json.add("settled", *record.settled);
  if (!record.goals.empty()) json.add("goals", record_of(record.goals));
  if (!record.forces.empty()) json.add("forces", record_of(record.forces));
  for (const auto& [name, ranges] :
       {std::pair{"first_heights", &record.first_heights}, {"layer_thickness", &record.thickness}}) {
    JsonObject walls;
    for (const auto& [boundary, least, largest] : *ranges) walls.add(boundary, std::vector{least, largest});
    if (!ranges->empty()) json.add(name, walls);
  }
  if (record.metric) json.add("metric", record_of(*record.metric));
  return json;
}

JsonObject record_of(const std::vector<flow::GoalValue>& goals) {
  JsonObject json;
  for (const flow::GoalValue& goal : goals) {
    json.add(goal.name, object({{"value", goal.value},
                                {"corrected", goal.corrected},
                                {"error", goal.error},
                                {"by_alpha", goal.by_alpha},
                                {"by_mach", goal.by_mach},
                                {"adjoint_residual", goal.residual}}));
  }
  return json;
}

JsonObject record_of(const flow::UnsteadyFlow& flow) {
  JsonObject json;
  json.add("from", flow.from);
  json.add("to", flow.to);
  json.add("steps", flow.steps);
  json.add("implicit", flow.implicit);
  json.add("unsolved", flow.unsolved);
  for (const auto& [name, swing] : {std::pair{"cl", flow.cl}, {"cd", flow.cd}}) {
    json.add(name, object({{"mean", swing.mean}, {"smallest", swing.smallest}, {"largest", swing.largest}}));
  }
  json.add("period", flow.period);
  json.add("strouhal", flow.strouhal);
  json.add("steady_steps", flow.steady_steps);
  json.add("steady_residual", flow.steady_residual);
  return json;
}

std::string line_of(const flow::GoalValue& goal) {
  return fmt::format(
      "{} {:.6f}, corrected {:.6f}, error without signs {:.2e}; by alpha {:.5g}, by mach {:.5g}", goal.name,
      goal.value, goal.corrected, goal.error, goal.by_alpha, goal.by_mach);
}

JsonObject record_of(const std::vector<flow::BoundaryForce>& forces) {
  JsonObject json;
  for (const flow::BoundaryForce& force : forces) {
    json.add(force.boundary, object({{"cl", force.cl},
                                     {"cd", force.cd},
                                     {"cl_friction", force.cl_friction},
                                     {"cd_friction", force.cd_friction}}));
  }
  return json;
}

std::string quality_text(const CycleRecord& record) {
  if (!record.layered) return fmt::format("smallest angle {:>4.1f}", record.worst_angle);
  return fmt::format(
      "smallest angle outside layers {:>4.1f}, layers: aspect ratio {:.4g}, non-orthogonality {:.1f}, "
      "skewness "
      "{:.2f}",
      record.layered->outer_angle, record.layered->aspect_ratio, record.layered->non_orthogonality,
      record.layered->skewness);
}

JsonObject seconds_of(const CycleRecord& record) { return object(record.seconds); }

std::string json_text(const CycleRecord& record) {
  JsonObject settings, json = statistics_of(record);
  for (const auto& [key, value] : record.settings) settings.add_raw(key, value);
  json.add_raw("case", settings.lines("  "));
  json.add("seconds", seconds_of(record));
  return json.lines() + "\n";
}

std::optional<double> recorded_number(const std::string& text, const std::string& key) {
  const Json json = parsed(text);
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return {};
  return found->get<double>();
}

std::optional<bool> recorded_flag(const std::string& text, const std::string& key) {
  const Json json = parsed(text);
  const auto found = json.find(key);
  if (found == json.end() || !found->is_boolean()) return {};
  return found->get<bool>();
}

std::optional<RecordedCase> recorded_case(const std::string& text) {
  const Json json = parsed(text);
  const auto of_case = digest_in(json, "case_digest"), of_geometry = digest_in(json, "geometry_digest");
  if (!of_case || !of_geometry || !text.ends_with('\n')) return {};
  return RecordedCase{*of_case, *of_geometry, digest_in(json, "solution_digest"), settings_in(json)};
}

}  // namespace quadloop::adapt
