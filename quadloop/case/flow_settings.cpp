#include "quadloop/case/flow_settings.hpp"

#include <fmt/format.h>

#include <cmath>

namespace quadloop {

std::optional<flow::FreeStream> FlowSettings::stream() const {
  if (!pressure) return {};
  return flow::FreeStream{density, *pressure, speed, alpha, gamma, viscosity(), reference_length};
}

const KeyTable<FlowSettings>& flow_keys() {
  static const KeyTable<FlowSettings> keys{
      "flow",
      {key<&FlowSettings::reynolds>(
           "reynolds", number(io::Range::positive()),
           "Reynolds number based on `reference_length`, at least 1000. With `pressure` any number above 0 "
           "is "
           "allowed; without `reynolds` the walls then have no friction.",
           {.example = "5000",
            .required = {{"speed times reference length over kinematic viscosity", "no pressure"}}}),
       key<&FlowSettings::reference_length>("reference_length", number(io::Range::positive()),
                                            "Reference length of `reynolds`.", {.unit = "length"}),
       key<&FlowSettings::density>("density", number(io::Range::positive()),
                                   "Free-stream density in the units of the solver."),
       key<&FlowSettings::speed>("speed", number(io::Range::positive()),
                                 "Free-stream speed in the units of the solver. Viscosity is density times "
                                 "speed times `reference_length` / `reynolds`."),
       key<&FlowSettings::pressure>("pressure", number(),
                                    "Free-stream pressure; in general 0 for incompressible flow. It enables "
                                    "[wall forces](adaptive-run.md#wall-forces).",
                                    {.fallback = "none"}),
       key<&FlowSettings::alpha>("alpha", number({-360, 360}), "Angle of attack of the free stream.",
                                 {.unit = "degrees"}),
       key<&FlowSettings::gamma>("gamma", number({1, 10, true, false}), "Ratio of specific heats."),
       key<&FlowSettings::mach>(
           "mach", number({0, 100, true, false}),
           "Free-stream Mach number instead of `speed`. The speed of sound is that of `pressure` and "
           "`density`; "
           "without a pressure it is 1. Both keys may be given if they agree.",
           {.fallback = "none",
            .needs = {{"pressure > 0 or no pressure", "another pressure has no speed of sound"},
                      {"pressure or no speed", "give one of mach and speed"}}})}};
  return keys;
}

namespace {

void take_mach(const io::CaseTable& table, FlowSettings& flow) {
  if (!flow.mach) return;
  const double sound = flow.pressure ? std::sqrt(flow.gamma * *flow.pressure / flow.density) : 1;
  if (!table.has("speed")) flow.speed = *flow.mach * sound;
  if (std::abs(flow.speed - *flow.mach * sound) > 0.01 * flow.speed)
    table.refuse("mach",
                 fmt::format("is {}, but speed, density, pressure and gamma make {:.4g}; correct one of "
                             "them, or leave mach out",
                             *flow.mach, flow.speed / sound));
}

}  // namespace

std::optional<FlowSettings> read_flow_table(const io::CaseTable& root) {
  const auto table = root.table("flow");
  if (!table) return {};
  FlowSettings flow;
  flow.where = table->place();
  flow_keys().read(*table, flow);
  take_mach(*table, flow);
  if (!flow.pressure) table->number("reynolds", {FlowSettings::least_reynolds});
  return flow;
}

}  // namespace quadloop
