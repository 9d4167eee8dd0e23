#include "quadloop/case/flow_settings.hpp"

namespace quadloop {

std::optional<FreeStream> FlowSettings::stream() const {
  if (!pressure) return {};
  return FreeStream{density, *pressure, speed, alpha, gamma, viscosity(), reference_length};
}

std::optional<FlowSettings> read_flow_table(const CaseTable& root) {
  const auto table = root.table("flow");
  if (!table) return {};
  FlowSettings flow;
  flow.where = table->place();
  flow.pressure = table->number("pressure", {});
  flow.reynolds =
      table->number("reynolds", flow.pressure ? Range::positive() : Range{FlowSettings::least_reynolds});
  if (!flow.reynolds && !flow.pressure)
    table->refuse("reynolds", "is missing: speed times reference length over kinematic viscosity");
  flow.reference_length =
      table->number("reference_length", Range::positive()).value_or(flow.reference_length);
  flow.density = table->number("density", Range::positive()).value_or(flow.density);
  flow.speed = table->number("speed", Range::positive()).value_or(flow.speed);
  flow.alpha = table->number("alpha", {-360, 360}).value_or(flow.alpha);
  flow.gamma = table->number("gamma", {1, 10, true, false}).value_or(flow.gamma);
  table->number("mach", {0, 100});  // for the reader: the others tell it
  table->finish();
  return flow;
}

}  // namespace quadloop
