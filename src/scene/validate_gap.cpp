#include "scene_file.hpp"

#include <fmt/format.h>

namespace launchsafe::scene {
namespace {

Fault check_gaps(const SceneFile& file) {
  const bool cooled = file.scene.surface.opens_by_cooling.has_value();
  if (cooled && file.given.contains("gap.thickness"))
    return fault_at(file, "gap.thickness", "it beside gap.opens_by_cooling, from which the gap follows",
                    "one of the two");
  const char* key = cooled ? "gap.opens_by_cooling" : "gap.thickness";
  std::vector<double> gaps = file.scene.surface.gaps;
  std::ranges::sort(gaps);
  const auto twice =
      std::ranges::adjacent_find(gaps, [](double a, double b) { return b - a <= 1e-9 * std::max(b, 1e-6); });
  if (twice != gaps.end()) {
    return fault_at(file, "gap.thickness", fmt::format("{} twice", length_text(*twice)), "each gap once");
  }
  const bool closes = file.scene.surface.model == GapModel::closing;
  const double largest = closes ? 0.02 : 0.01;
  if (!gaps.empty() && gaps.back() > largest) {
    return fault_at(
        file, key, (cooled ? "a gap of " : "") + length_text(gaps.back()),
        fmt::format("at most {}{}", length_text(largest), closes ? "" : ", or gap.model = \"closing\""));
  }
  if (!gaps.empty() && (gaps.back() > 0.0 || cooled) && !has_charge(file.scene)) {
    return fault_at(file, key,
                    fmt::format("a gap of {} in a scene without a charge", length_text(gaps.back())),
                    "gaps only under a body of material \"charge\"");
  }
  return std::nullopt;
}

/// Keys of one model of the gap beside another one. Those that both have, or that a verdict needs of the
/// reservoir beside a closing gap, are none of them.
Fault check_keys_of_model(const SceneFile& file) {
  const Surface& surface = file.scene.surface;
  const auto beside = [&](const char* key, const char* model, const char* other) {
    return fault_at(file, key, fmt::format("a key of gap.model = \"{}\" beside \"{}\"", model, other),
                    fmt::format("absent, or gap.model = \"{}\"", model));
  };
  if (surface.model == GapModel::reservoir) {
    for (const char* key :
         {"gap.roughness", "gap.base", "gap.air_flow", "gap.release", "gap.release_duration", "gap.melts",
          "gap.air_cells", "gap.depth_cells", "gap.turns"})
      if (file.given.contains(key)) return beside(key, "closing", "reservoir");
    return std::nullopt;
  }
  // Stored scenes have both written out.
  if (file.given.contains("gap.release_duration") && !file.given.contains("gap.release"))
    return fault_at(file, "gap.release_duration",
                    "it without gap.release: a charge that is free has nothing to let go",
                    "gap.release, until when the charge is held, beside it");
  if (surface.air_model != AirModel::reservoir) return beside("gap.air", "reservoir", "closing");
  if (surface.exchange != Exchange::rate) return beside("gap.exchange", "reservoir", "closing");
  if (surface.air_pressure != AirPressure::charge_bottom)
    return beside("gap.pressure", "reservoir", "closing");
  return std::nullopt;
}

/// A charge that flies has to be free of its base, and the mechanics has to have its gap.
Fault check_closing(const SceneFile& file) {
  const Scene& scene = file.scene;
  if (scene.surface.model == GapModel::reservoir) return std::nullopt;
  const auto closing = [&](std::string found, std::string allowed) {
    return fault_at(file, "gap.model", "\"closing\" " + found, allowed + ", or gap.model = \"reservoir\"");
  };
  if (body_under_charge(scene) == nullptr)
    return closing("with nothing under the charge", "a body at the charge's bottom");
  for (const Body& body : scene.bodies) {
    if (!lies_under_charge(scene, body)) continue;
    const auto faces =
        std::ranges::find_if(scene.interfaces, [&](const Interface& each) { return each.body == body.name; });
    if (faces == scene.interfaces.end() || faces->condition != Condition::sliding)
      return closing(fmt::format("with a charge bonded to \"{}\" under it", body.name),
                     fmt::format("[interface.{}] with condition = \"sliding\" and its friction", body.name));
  }
  if (scene.numerics.formulation == Formulation::updated_lagrangian)
    return closing("with numerics.formulation = \"updated-lagrangian\", whose bodies share a grid",
                   "the formulation \"total-lagrangian\"");
  if (scene.coupling == Coupling::two_way)
    return closing("with coupling = \"two-way\": combustion is not followed in a gap that closes",
                   "coupling = \"one-way\"");
  return std::nullopt;
}

}  // namespace

Fault fault_of_gap(const SceneFile& file) {
  for (const auto check : {check_gaps, check_keys_of_model, check_closing})
    if (Fault fault = check(file)) return fault;
  return std::nullopt;
}

}  // namespace launchsafe::scene
