#include "io/step/step_reader.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "io/step/step_model.hpp"
#include "io/step/step_plane.hpp"

namespace quadloop::io {

namespace {

void add_warnings(const std::string& path, const StepModel& model, double extent,
                  std::vector<std::string>& warnings) {
  constexpr double rounding = 1e-6;
  if (!model.left_out.empty())
    warnings.push_back(fmt::format("{}: left out: {}", path, model.left_out.text()));
  if (model.inner_edges > 0)
    warnings.push_back(
        fmt::format("{}: {} edges between faces of a sheet are left out", path, model.inner_edges));
  if (model.largest_deviation > rounding * extent)
    warnings.push_back(
        fmt::format("{}: vertices are up to {:.3g} off the curves of their edges; the curves are joined "
                    "at the vertices",
                    path, model.largest_deviation));
}

std::string name_of(const StepCurve& curve, const DrawingChoice& choice, const std::string& path) {
  using From = BoundaryNames::From;
  const From from = choice.names.from;
  if (from != From::layer && from != From::file && !curve.name.empty()) return curve.name;
  if (from != From::file && !curve.layer.empty()) return curve.layer;
  return std::filesystem::path(path).stem().string();
}

}  // namespace

std::vector<Chain> read_step(const std::string& path, const DrawingChoice& choice,
                             std::vector<std::string>& warnings, FileUnit& unit) {
  const Part21File file(path);
  const StepModel model = read_step_model(file, choice);
  unit = {model.units.length, model.units.metres, {model.layers.begin(), model.layers.end()}, {}};
  if (model.curves.empty()) refuse_empty(path, choice, unit.layers, model.left_out);
  const StepPlane plane = plane_of(model.curves);
  if (plane.name() != "XY") unit.plane = plane.name();
  add_warnings(path, model, plane.extent, warnings);
  std::vector<Chain> chains;
  for (const StepCurve& curve : model.curves) {
    Chain chain = chain_in(plane, curve.curve);
    chain.name = one_word(name_of(curve, choice, path));
    chain.source = curve.entity.place();
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace quadloop::io
