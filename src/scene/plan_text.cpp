// The plan as people read it.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {
namespace {

/// A line of a list; none without a value.
std::string labelled(std::string_view label, const std::string& value) {
  return value.empty() ? value : fmt::format("  {:<22}{}\n", label, value);
}

/// A charge that shrank away from its base as it cooled, held at its nose.
std::string cooling_text(const Scene& scene) {
  const Extent charge = charge_extent(scene);
  const double rate = opening_by_cooling(scene), length = charge.x_end - charge.x_begin;
  std::string text =
      fmt::format("expands by {} more than its shell and parts from the base by {:.3g} µm a kelvin below ",
                  format_quantity(rate / length, Dimension::expansion), 1e6 * rate);
  if (!scene.surface.opens_by_cooling) return text + "the temperature at which it filled the shell";
  const double gap = gap_by_cooling(scene);
  return text + fmt::format("{:.6g} K: {} at {:.6g} K", *scene.surface.opens_by_cooling,
                            gap > 0.0 ? "a gap of " + length_text(gap) : "no gap", scene.initial_temperature);
}

std::string bodies_text(const Scene& scene) {
  std::string text = "Bodies\n";
  for (const Body& body : scene.bodies) {
    const ParticleCount count = particles_of(scene, body);
    text +=
        labelled(body.name, fmt::format("{}, x {:.6g} to {:.6g} cm, r {:.6g} to {:.6g} cm, {} x {} particles",
                                        material_text(scene, body), 100 * body.x_begin, 100 * body.x_end,
                                        100 * body.r_begin, 100 * body.r_end, count.nx, count.nr));
  }
  const char* unit = scene.symmetry == Symmetry::axisymmetric ? "kg" : "kg per metre, half model";
  std::vector<std::string> parts;
  for (const Material& material : used_materials(scene))
    parts.push_back(fmt::format("{} {:.6g}", material.name, mass_of(scene, material.name)));
  text += labelled("mass", fmt::format("{:.6g} {} ({})", total_mass(scene), unit, fmt::join(parts, ", ")));
  if (has_charge(scene) && (scene.surface.opens_by_cooling || scene.surface.model == GapModel::closing))
    text += labelled("a charge that cooled", cooling_text(scene));
  return text;
}

std::string load_text(const Scene& scene) {
  const double peak = PressureHistory(scene.load).peak();
  std::string text = "Load\n";
  text += labelled("shape", scene.load.curve_time.empty()
                                ? word_of(scene.load.shape)
                                : fmt::format("measured, {} points{}", scene.load.curve_time.size(),
                                              scene.load.rescale_to_peak ? ", rescaled" : ""));
  text += labelled("peak", pressure_text(peak));
  text += labelled("acts", chamber_text(scene, peak));
  text += labelled("muzzle exit", exit_text(scene));
  text += labelled("end", end_text(scene));
  text += labelled("measurement", measured_load_text(scene.load));
  text += labelled("rigid acceleration", fmt::format("{:.6g} m/s2", rigid_acceleration(scene, peak)));
  if (has_charge(scene)) text += labelled("setback pressure", pressure_text(setback_pressure(scene)));
  return text;
}

std::string physics_text(const Plan& plan) {
  std::string text = "Physics\n";
  for (const NamedTerm& each : plan_terms) {
    const Term& term = plan.*each.term;
    text += labelled(each.title, fmt::format("{:<4}{}", term.in ? "in" : "out", term.reason));
  }
  return text;
}

std::string interfaces_text(const Scene& scene) {
  std::string text;
  for (const InterfaceText& each : describe_interfaces(scene))
    text += labelled(each.body, each.condition + ": " + each.assumes);
  return text.empty() ? text : "Interfaces of the charge\n" + text + "\n";
}

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.1f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (!(seconds < 1e9)) return fmt::format("{:.3g} days", seconds / 86400.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string lengths_text(double shortest, double longest) {
  if (longest - shortest <= 1e-6 * longest) return fmt::format("{:.4g} mm", 1e3 * shortest);
  return fmt::format("{:.4g} to {:.4g} mm", 1e3 * shortest, 1e3 * longest);
}

std::string cost_text(const Plan& plan, const Scene& scene, double update_rate) {
  const CellRange cells = cells_of(scene);
  std::string text = "Cost\n";
  text += labelled("mesh", fmt::format("{} x {} cells, {} in x, {} in r, {} particles", cells.nx, cells.nr,
                                       lengths_text(cells.shortest_x, cells.longest_x),
                                       lengths_text(cells.shortest_r, cells.longest_r), plan.particles()));
  if (const std::string edges = charge_edges_off_grid(scene); !edges.empty())
    text += labelled("charge off the grid",
                     edges + "; calibrated constants do not carry over from a grid that fits");
  text += labelled("time step", fmt::format("{} at rest, sound at {:.2f} m/s", time_text(plan.time_step),
                                            longitudinal_speed(scene)));
  text += labelled("steps", plan.steps < most_counted ? fmt::format("{}", plan.steps) : "too many to count");
  text += labelled("memory", fmt::format("about {:.3g} MB", plan.memory / 1e6));
  if (update_rate > 0.0) {
    text += labelled("time", fmt::format("about {} at {:.3g} particle updates per second",
                                         duration_text(predicted_time(plan, update_rate)), update_rate));
    if (plan.coupling.in)
      text += labelled("through ignition", fmt::format("about {} more, at most, for every gap that ignites",
                                                       duration_text(plan.coupled_work / update_rate)));
  }
  return text;
}

}  // namespace

std::string to_text(const Plan& plan, const Scene& scene, double update_rate) {
  return fmt::format("{}{}{}\n{}{}\n{}\n{}", scene.title, scene.title.empty() ? "" : "\n\n",
                     bodies_text(scene), interfaces_text(scene), load_text(scene), physics_text(plan),
                     cost_text(plan, scene, update_rate));
}

}  // namespace launchsafe::scene
