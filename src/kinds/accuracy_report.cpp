// The answer, the picture, the page and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

namespace {

std::string kelvins(double value) { return in_words(value, significant(2, kelvin)); }
std::string at_most(double value, keys::Unit unit) {
  return in_words(value, report::up(significant(2, unit)));
}

/// Numerics that the reference meshes share and no setting varies: no error is known then.
std::string unvaried_text(const AccuracyResult& result) {
  std::vector<std::string> shared;
  for (const std::string& name : result.reference->unvaried) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    shared.push_back(
        fmt::format("{} = {}", name, scene::format_value(key, key.get(result.study.scene.scene))));
  }
  return fmt::format("{}", fmt::join(shared, ", "));
}

/// "its limit", where the meshes justify one.
const char* reference_text(bool has_limit) {
  return has_limit ? "the limit of the meshes" : "the finest mesh (no extrapolation is justified)";
}

/// How wrong T max and the critical gap of the scene as it is may be.
std::string error_text(const AccuracyResult& result, const AccuracyRow& own) {
  if (const std::string shared = unvaried_text(result); !shared.empty())
    return fmt::format(
        "The error of T max is not known: all reference meshes have {}, and no setting shows what the exact "
        "value would change. Run the meshes with the exact value, or add [[settings]] that differ from "
        "another setting in this key alone, at its exact value.",
        shared);
  const bool has_limit = std::ranges::all_of(result.reference->temperature,
                                             [](const ReferenceValue& each) { return each.limit.justified; });
  std::string text = fmt::format(
      "With the setting of the scene, T max is off by at most about {} over the compared gaps; it is {} from "
      "{}.",
      at_most(own.temperature_bound, kelvin), kelvins(own.largest_temperature_error),
      reference_text(has_limit));
  const math::Extrapolation& gap = result.reference->critical_gap.limit;
  if (std::isfinite(own.critical_gap_bound))
    text += fmt::format(" Its critical gap, {}, is off by at most about {}; that of {} is {}.",
                        in_words(own.critical_gap, significant(4, centimetre)),
                        at_most(own.critical_gap_bound, centimetre), reference_text(gap.justified),
                        in_words(gap.value, significant(4, centimetre)));
  return text;
}

/// The cheapest setting whose T max is within `tolerance` (K); nullptr without one.
const AccuracyRow* cheapest_within(const std::vector<AccuracyRow>& rows, double tolerance) {
  const AccuracyRow* best = nullptr;
  for (const AccuracyRow& row : rows)
    if (row.comparable() && row.temperature_bound <= tolerance &&
        !(best && best->processor_time <= row.processor_time))
      best = &row;
  return best;
}

std::string cheapest_text(const AccuracyResult& result) {
  std::string text;
  const AccuracyRow* last = nullptr;
  for (const double tolerance : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const AccuracyRow* row = cheapest_within(result.rows, tolerance);
    if (row == nullptr || row == last) continue;
    last = row;
    text += fmt::format("\n- T max within {:g} K: {} ({}, {})", tolerance, row->label,
                        at_most(row->temperature_bound, kelvin),
                        in_words(row->processor_time, significant(3, second)));
  }
  return text.empty() ? "" : "\nCheapest settings:" + text;
}

/// "3 K from its limit": the scene's own setting. What is nearer than the limit is known to cannot be told
/// from that.
std::string finding_of(const AccuracyResult& result) {
  const AccuracyRow* own = result.baseline();
  if (own == nullptr) return {};
  const double distance = own->largest_temperature_error,
               told = std::max(distance, result.reference_uncertainty());
  return (distance < told ? "within " : "") + kelvins(told) +
         (distance < told ? " of its limit" : " from its limit");
}

}  // namespace

Plot error_plot(const AccuracyResult& result) {
  constexpr int blue = 0, vermilion = 1, grey = 7;
  const double known_to = result.reference_uncertainty();
  Plot plot{
      .title = {},
      .x = {headed("processor time of a run", quantity::processor_time).label(), report::Scale::logarithmic},
      .y = {headed("distance of T max from its limit", quantity::temperature_max).label(),
            report::Scale::logarithmic},
      .width = 700,
      .height = 440};
  const auto points = [](std::string label, int colour, Mark mark) {
    return Series{.label = std::move(label), .style = Style::points, .colour = colour, .mark = mark};
  };
  Series meshes = points("reference meshes", blue, Mark::open_square);
  Series others = points("other settings", grey, Mark::circle);
  const auto add_mark = [&](const AccuracyRow& row, double distance, Series& series) {
    if (std::isfinite(distance)) series.add(row.processor_time, std::max(distance, known_to));
  };
  for (const AccuracyRow& row : result.rows)
    if (row.computed() && !row.other_model && (row.reference_mesh || !row.baseline))
      add_mark(row, row.largest_temperature_error, row.reference_mesh ? meshes : others);
  plot.title = "As in the scene T max is " + finding_of(result);
  plot.series = {std::move(others), std::move(meshes)};
  Series& scene = plot.series.emplace_back(points("as in the scene", vermilion, Mark::diamond));
  if (const AccuracyRow* own = result.baseline()) add_mark(*own, own->largest_temperature_error, scene);
  std::erase_if(plot.series, [](const Series& each) { return each.x.empty(); });
  if (std::isfinite(known_to) && known_to > 0) {
    plot.y.minimum = 0.5 * known_to;
    plot.subtitle = "the limit is known to " + kelvins(known_to);
  }
  if (result.reference && !result.reference->unvaried.empty())
    plot.subtitle = "no bound of the error is known: the reference itself may be off";
  return plot;
}

std::string answer(const AccuracyResult& result) {
  if (!result.reference) return fmt::format("There is no reference: {}.", result.no_reference);
  const AccuracyRow* own = result.baseline();
  return (own == nullptr ? "The scene's own setting did not run soundly." : error_text(result, *own)) +
         cheapest_text(result) + "\n";
}

Report report_of(const AccuracyResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  if (result.reference) report.draw({"error_against_time.svg", error_plot(result), "error against run time"});
  report.add({setting_table(result), "accuracy.csv", "settings"});
  report.add({reference_table(result), "reference.csv", "reference", Shown::page});
  report.say(
      "In files: cost and errors of every setting (`accuracy.csv`), and the reference meshes with the "
      "observed order of T max and the critical gap (`reference.csv`).\n");
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.say("This computation " + report::timing_text(result.timing) + ".\n");
  report.json = study_json(result.study, report, {{"timing", report::timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
