#include "launchsafe/study/causes.hpp"

#include "launchsafe/scene/load.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/surface/after_launch.hpp"

namespace launchsafe::study {
namespace {

using scene::Scene, surface::SkinModel, trace::BottomTrace;

constexpr double round_off = 1e-9;

// --- launches beside the case's own ---

/// The cells far from bottom and side keep their limit: halving it too moves the critical gap of the 155 mm
/// shell by 2 % of what the finest cells move it, and doubles the cost of the launch.
Scene with_cells(Scene scene, double ratio) {
  scene.numerics.cell_size *= ratio;
  scene.numerics.largest_cell = std::max(scene.numerics.largest_cell, scene.numerics.cell_size);
  return scene;
}

/// With the cells that the constants of the case were fitted on.
Scene on_cells_of_constants(const StudyCase& input) {
  Scene scene = input.scene.scene;
  const scene::Numerics& fitted = input.scene.constants->scene.numerics;
  scene.numerics.cell_size = fitted.cell_size;
  scene.numerics.largest_cell = fitted.largest_cell;
  scene.numerics.growth_x = fitted.growth_x;
  scene.numerics.growth_r = fitted.growth_r;
  return scene;
}

bool has_other_cells(const StudyCase& input) {
  if (input.scene.constants == nullptr) return false;
  const scene::Numerics &own = input.scene.scene.numerics, &fitted = input.scene.constants->scene.numerics;
  return !same_number(own.cell_size, fitted.cell_size);
}

/// The same launch with a share more pressure, for the same time: only so its trace has a mirror image.
Scene with_raised_load(Scene scene, double share) {
  scene::Load& load = scene.load;
  load.duration = scene::end_time(load);
  load.peak *= 1.0 + share;
  if (!load.rescale_to_peak)
    for (double& pressure : load.curve_pressure) pressure *= 1.0 + share;
  return scene;
}

// --- shares ---

/// By how much critical gaps beside one of a case move it in each direction, m.
CauseShare share_of(Cause cause, double critical_gap, std::initializer_list<GapOrBound> ends) {
  CauseShare share{cause};
  for (const GapOrBound end : ends) {
    if (std::isnan(end)) return {cause, math::not_a_number, math::not_a_number};
    share.shorter = std::max(share.shorter, critical_gap - end);
    if (std::isfinite(end)) share.longer = std::max(share.longer, end - critical_gap);
  }
  return share;
}

SkinModel at_temperature(SkinModel skin, double rise) {
  skin.initial_temperature += rise;
  skin.surface.air = materials::warmed(skin.surface.air, rise);
  return skin;
}

/// The skin with more heat from the air and from friction by a factor.
SkinModel heated_more(SkinModel skin, double factor) {
  skin.surface.localisation *= factor;
  skin.surface.air.density *= factor;  // the heat that an exchange carries goes with it
  return skin;
}

/// Everything that the shares of one case are found from.
struct CauseFinder {
  const Study& study;
  const StudyCase& input;
  const std::vector<FinishedRun>& runs;
  double critical_gap;  ///< m
  const BottomTrace own = trace::of_rings(runs.front().result.mechanics.trace);
  const SkinModel skin = surface::skin_model(input.scene.scene);

  GapOrBound gap_of(const SkinModel& model, const BottomTrace& trace) const {
    const surface::IgnitionOfGaps ignites(model, trace);
    return critical_gap_near(std::cref(ignites), critical_gap, study.end_of_search());
  }

  /// The trace of a launch beside the case's own; nullptr where it did not complete.
  const BottomTrace* trace_of(Part part, const std::string& name = {}) const {
    const FinishedRun* run = find_part(runs, part, name);
    return run != nullptr && run->failure.empty() ? &run->result.mechanics.trace : nullptr;
  }

  /// m that a change of T max (K) is at the critical gap, by the slope of T max over the gap.
  double length_of(double temperature) const {
    constexpr double shortest = 1e-4;  // m
    const double end = std::max(critical_gap, shortest), begin = critical_gap > shortest ? 0.9 * end : 0.0;
    const double slope =
        (heated_temperature(skin, own, end) - heated_temperature(skin, own, begin)) / (end - begin);
    return temperature / slope;
  }

  CauseShare peak_pressure() const {
    const BottomTrace* raised = trace_of(Part::raised);
    if (raised == nullptr) return share_of(Cause::peak_pressure, critical_gap, {math::not_a_number});
    const auto lowered = trace::mirrored(runs.front().result.mechanics.trace, *raised);
    return share_of(Cause::peak_pressure, critical_gap,
                    {gap_of(skin, *raised), lowered ? gap_of(skin, *lowered) : math::not_a_number});
  }

  CauseShare pulse_length() const {
    const double factor = 1.0 + study.spreads.pulse_length;
    return share_of(
        Cause::pulse_length, critical_gap,
        {gap_of(skin, trace::stretched(own, factor)), gap_of(skin, trace::stretched(own, 1.0 / factor))});
  }

  CauseShare initial_temperature() const {
    const double rise = study.spreads.initial_temperature;
    return share_of(Cause::initial_temperature, critical_gap,
                    {gap_of(at_temperature(skin, rise), own), gap_of(at_temperature(skin, -rise), own)});
  }

  /// Its smoothing took from the peak, and its points may have missed it.
  CauseShare measured_curve() const {
    const scene::Load& load = input.scene.scene.load;
    const double kept = 1.0 - scene::peak_lost_to_smoothing(load);
    const double heat = std::pow((1.0 + scene::peak_missed_between_points(load)) / kept, heat_exponent);
    return share_of(Cause::measured_curve, critical_gap,
                    {gap_of(heated_more(skin, heat), own), gap_of(heated_more(skin, 1.0 / heat), own)});
  }

  /// The error that two meshes show, one with cells twice as large as the other, and the whole difference to
  /// the cells that the constants were fitted on. Never 0: a critical gap is solved to a length.
  CauseShare numerics() const {
    if (study.numerics.is_stated()) {
      const double length = length_of(study.numerics.error);
      return {Cause::numerics, length, length};
    }
    const BottomTrace* companion = trace_of(Part::companion);
    double error = math::not_a_number;
    if (companion != nullptr) {
      const double other = std::min(gap_of(skin, *companion), study.end_of_search());
      const double refined = std::pow(2.0, order_of_cells);
      const double of_finer = 1.0 / (refined - 1.0);  // error of the finer mesh over the difference
      error = factor_of_safety * std::abs(other - critical_gap) *
              (companion_ratio(input.scene.scene) > 1.0 ? of_finer : refined * of_finer);
    }
    if (has_other_cells(input)) {
      const BottomTrace* fitted = trace_of(Part::cells_of_constants);
      error += fitted == nullptr
                   ? math::not_a_number
                   : std::abs(std::min(gap_of(skin, *fitted), study.end_of_search()) - critical_gap);
    }
    return {Cause::numerics, error + gap_accuracy, error + gap_accuracy};
  }

  /// The constants of the skin at the ends of their fit on this launch, scaled so that T max moves by the
  /// largest temperature that the fit missed at the least; and the ignition temperature at its ends.
  CauseShare constants() const {
    const scene::Constants& fitted = *input.scene.constants;
    const scene::SkinConstants of_skin = scene::skin_constants(fitted);
    const std::size_t size = of_skin.keys.size();
    CauseShare squares{Cause::constants};
    if (const auto factor = math::covariance_factor(of_skin.covariance, size))
      for (std::size_t axis = 0; axis < size; ++axis) {
        const auto end = [&](double deviations) {
          Scene scene = input.scene.scene;
          for (std::size_t i = 0; i < size; ++i) {
            const auto& key = *scene::find_key(scene::scene_keys(), of_skin.keys[i]);
            key.set(scene,
                    std::get<double>(key.get(scene)) * std::exp(deviations * (*factor)[i * size + axis]));
          }
          return gap_of(surface::skin_model(scene), own);
        };
        const CauseShare one =
            share_of(Cause::constants, critical_gap, {end(coverage_factor), end(-coverage_factor)});
        squares.shorter += one.shorter * one.shorter;
        squares.longer += one.longer * one.longer;
      }
    const double missed = length_of(scene::largest_temperature_misfit(fitted));
    const auto at_trigger = [&](double temperature) {
      SkinModel triggered = skin;
      triggered.kinetics.ignition_temperature = temperature;
      return gap_of(triggered, own);
    };
    CauseShare share{Cause::constants};
    if (fitted.ignition_lowest > 0.0)
      share = share_of(Cause::constants, critical_gap,
                       {at_trigger(fitted.ignition_lowest), at_trigger(fitted.ignition_highest)});
    share.shorter += std::max(std::sqrt(squares.shorter), missed);
    share.longer += std::max(std::sqrt(squares.longer), missed);
    return share;
  }

  /// From the gap on whose skin is hot enough at the end of the launch to run away later.
  CauseShare after_launch() const {
    const double limit = surface::runaway_temperature(skin, skin.initial_temperature);
    if (std::isnan(limit)) return {Cause::after_launch, math::not_a_number, 0.0};
    const auto runs_away = [&](double gap) -> std::optional<bool> {
      const surface::SkinHistory history = surface::integrate_skin(skin, own, gap);
      if (history.ignition) return true;
      const double end = surface::maximum_at_time(history, own, own.time.back()).temperature;
      return std::isnan(end) ? std::nullopt : std::optional(end >= limit);
    };
    const GapOrBound gap = critical_gap_near(runs_away, critical_gap, study.end_of_search());
    return {Cause::after_launch, std::isnan(gap) ? gap : std::max(0.0, critical_gap - gap), 0.0};
  }

  CauseShare models(const CriticalGap& critical) const {
    CauseShare share{Cause::models};
    for (const ModelGap& each : gaps_of_models(study, input, runs, critical)) {
      const CauseShare one = share_of(Cause::models, critical_gap, {each.critical_gap});
      if (std::isnan(one.shorter)) return one;
      share.shorter = std::max(share.shorter, one.shorter);
      share.longer = std::max(share.longer, one.longer);
    }
    return share;
  }
};

const char* title_of(Part part) {
  switch (part) {
    case Part::raised:
      return "the launch with a raised peak pressure";
    case Part::companion:
      return "the companion launch with other cells";
    case Part::cells_of_constants:
      return "the launch on the cells of its constants";
    case Part::model:
      return "the launch under constants";
    default:
      return "the launch";
  }
}

}  // namespace

double companion_ratio(const scene::Scene& scene) {
  constexpr double fewest_cells = 2.0;
  const double station = std::min(scene.surface.station_width, scene.surface.station_depth);
  return station >= (1.0 - round_off) * fewest_cells * 2.0 * scene.numerics.cell_size ? 2.0 : 0.5;
}

std::vector<SideLaunch> side_launches(const Study& study, const StudyCase& input) {
  if (!study.kind.gives_verdicts) return {};
  std::vector<SideLaunch> launches;
  if (const double share = study.spreads.peak_pressure; share > 0.0)
    launches.push_back({Part::raised, {}, [share](const StudyCase& own) {
                          return with_raised_load(own.scene.scene, share);
                        }});
  if (!study.numerics.is_stated()) {
    launches.push_back({Part::companion, {}, [](const StudyCase& own) {
                          return with_cells(own.scene.scene, companion_ratio(own.scene.scene));
                        }});
    if (has_other_cells(input)) launches.push_back({Part::cells_of_constants, {}, on_cells_of_constants});
  }
  for (const auto& model : study.models)
    launches.push_back({Part::model, name_of_model(*model),
                        [model](const StudyCase& own) { return scene_of_model(own, model); }});
  return launches;
}

std::vector<CauseShare> causes_of(const Study& study, const StudyCase& input,
                                  const std::vector<FinishedRun>& runs, const CriticalGap& critical) {
  if (critical.kind == CriticalGapKind::unknown) return {};
  const CauseFinder finder{study, input, runs, critical.value};
  std::vector<std::function<CauseShare()>> finders;
  const auto add = [&](bool applies, auto find) {
    if (applies) finders.emplace_back(std::move(find));
  };
  add(study.spreads.peak_pressure > 0.0, [&] { return finder.peak_pressure(); });
  add(study.spreads.pulse_length > 0.0, [&] { return finder.pulse_length(); });
  add(study.spreads.initial_temperature > 0.0, [&] { return finder.initial_temperature(); });
  add(!input.scene.scene.load.curve_time.empty(), [&] { return finder.measured_curve(); });
  add(true, [&] { return finder.numerics(); });
  add(input.scene.constants != nullptr, [&] { return finder.constants(); });
  add(true, [&] { return finder.after_launch(); });
  add(!study.models.empty(), [&] { return finder.models(critical); });
  std::vector<CauseShare> shares(finders.size());
  run_parts(shares.size(), [&](std::size_t i) { shares[i] = finders[i](); });
  return shares;
}

std::vector<ModelGap> gaps_of_models(const Study& study, const StudyCase& input,
                                     const std::vector<FinishedRun>& runs, const CriticalGap& critical) {
  std::vector<ModelGap> gaps;
  for (const auto& model : study.models) {
    ModelGap& gap = gaps.emplace_back(ModelGap{name_of_model(*model)});
    const FinishedRun* run = find_part(runs, Part::model, gap.name);
    if (run == nullptr || !run->failure.empty() || critical.kind == CriticalGapKind::unknown) continue;
    const surface::IgnitionOfGaps ignites(surface::skin_model(scene_of_model(input, model)),
                                          run->result.mechanics.trace);
    gap.critical_gap = critical_gap_near(std::cref(ignites), critical.value, study.end_of_search());
  }
  return gaps;
}

std::string incomplete_launches(const std::vector<FinishedRun>& runs) {
  std::vector<std::string> texts;
  for (const FinishedRun& run : runs)
    if (run.part != Part::own && run.part != Part::through_ignition && !run.failure.empty())
      texts.push_back(fmt::format("{}{}{} did not complete: {}", title_of(run.part),
                                  run.name.empty() ? "" : " ", run.name, run.failure));
  return fmt::format("{}", fmt::join(texts, "; "));
}

surface::SkinModel without_reaction(surface::SkinModel model) {
  constexpr double never = std::numeric_limits<double>::max();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = never;
  model.kinetics.burnt_temperature = never;
  return model;
}

double heated_temperature(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(without_reaction(model), trace, gap), trace)
      .temperature;
}

}  // namespace launchsafe::study
