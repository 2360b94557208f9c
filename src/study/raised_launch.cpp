// A launch on other terms than those of its verdicts: with one cause of uncertainty at an end of its range.
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::study {
namespace {

using SharedTrace = std::shared_ptr<const trace::BottomTrace>;

/// The case's own trace; it outlives what is made of it.
SharedTrace own_trace(const CaseOutcome& outcome) { return {SharedTrace{}, &outcome.result.mechanics.trace}; }

SharedTrace trace_at_pressure(const CaseOutcome& outcome, End end) {
  if (end == End::towards_ignition) return {SharedTrace{}, &outcome.raised->trace};
  auto lowered = trace::mirrored(outcome.result.mechanics.trace, outcome.raised->trace);
  return lowered ? std::make_shared<trace::BottomTrace>(std::move(*lowered)) : SharedTrace{};
}

SharedTrace trace_of_length(const CaseOutcome& outcome, End end) {
  const double factor = 1.0 + assumed_pulse_spread;
  return std::make_shared<trace::BottomTrace>(
      trace::stretched(outcome.result.mechanics.trace, end == End::towards_ignition ? factor : 1.0 / factor));
}

surface::SkinModel at_temperature(surface::SkinModel skin, End end) {
  const double rise = end == End::towards_ignition ? assumed_temperature_spread : -assumed_temperature_spread;
  skin.initial_temperature += rise;
  skin.surface.air = materials::warmed(skin.surface.air, rise);
  return skin;
}

/// The skin with more heat from the air and from friction by these factors.
surface::SkinModel heated_more(surface::SkinModel skin, double friction, double air) {
  skin.surface.localisation *= friction;
  skin.surface.air.density *= air;  // the heat that an exchange carries goes with it
  return skin;
}

/// Adds the causes of one case.
struct Causes {
  const Study& study;
  const CaseOutcome& outcome;
  End end;
  surface::SkinModel skin = surface::skin_model(outcome.input.scene.scene);
  SharedTrace trace = own_trace(outcome);
  double rise = not_a_number;  ///< K, of a skin that does not react
  std::vector<RaisedLaunch> raised = {};

  void add_inputs() {
    if (!outcome.raised) return;
    add(ShareKind::peak_pressure, skin, trace_at_pressure(outcome, end));
    add(ShareKind::pulse_length, skin, trace_of_length(outcome, end));
    add(ShareKind::initial_temperature, at_temperature(skin, end), trace);
  }

  void add_knowledge(const GapVerdict& row) {
    rise = row.heated - outcome.input.scene.scene.initial_temperature;
    const Uncertainty& u = row.uncertainty;
    if (!outcome.raised) add_temperature(ShareKind::stated_inputs, u.input);
    if (u.load_curve > 0.0) add_load_curve();
    // Without sliding, which may be infinite.
    add_temperature(ShareKind::computation, u.sampling + u.integration + u.coupling + u.numerical);
    const bool slides = friction_share(outcome) > 0.0 || opening_at_base(outcome) > 0.0;
    if (u.sliding > 0.0 && slides) add_sliding();
    add_temperature(ShareKind::fit, u.fit);
    add_accepted();
  }

  bool towards() const { return end == End::towards_ignition; }

  void add(ShareKind kind, surface::SkinModel its_skin, SharedTrace its_trace, double thicker = 0.0) {
    raised.push_back({kind, std::move(its_skin), std::move(its_trace), thicker});
  }

  /// Of a launch that heats nothing, no factor on its heat makes the skin hotter.
  SharedTrace trace_where_known(double factor) const {
    return rise > 0.0 && std::isfinite(factor) ? trace : SharedTrace{};
  }

  /// A cause that is known as a change of T max, K.
  void add_temperature(ShareKind kind, double change) {
    if (change == 0.0) return;
    const double factor = towards() ? 1.0 + change / rise : std::max(0.0, 1.0 - change / rise);
    add(kind, heated_more(skin, factor, factor), trace_where_known(factor));
  }

  void add_load_curve() {
    const double factor = 1.0 + load_curve_share(outcome.input.scene.scene.load);
    const double heat = towards() ? factor : 1.0 / factor;
    add(ShareKind::load_curve, heated_more(skin, heat, heat), trace);
  }

  /// Heat and opening that the temperatures leave out: there is nothing to take away at the other end.
  void add_sliding() {
    if (!towards()) return;
    const double factor = 1.0 + friction_share(outcome) / rise;
    add(ShareKind::sliding, heated_more(skin, factor, factor), trace_where_known(factor),
        opening_at_base(outcome));
  }

  /// Constants that somebody accepts buy nothing: what the calibrated ones change is not known to be wrong.
  void add_accepted() {
    if (!study.kind.gives_verdicts || !towards()) return;
    const scene::Scene &scene = outcome.input.scene.scene, &calibrated = study.calibration.scene;
    const std::vector<std::string> keys = skin_keys(outcome.evidence->input.to_be_accepted());
    if (!keys.empty())
      add(ShareKind::accepted, surface::skin_model(with_calibrated(scene, calibrated, keys)), trace);
  }
};

}  // namespace

std::vector<RaisedLaunch> raised_launches(const Study& study, const CaseOutcome& outcome, End end,
                                          const GapVerdict* row) {
  Causes causes{study, outcome, end};
  causes.add_inputs();
  if (row != nullptr) causes.add_knowledge(*row);
  return std::move(causes.raised);
}

}  // namespace launchsafe::study
