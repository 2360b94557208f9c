// The answer, the picture, the page and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

namespace {

Row facts_of(const AccuracyRow& row) {
  return {{"label", row.label}, {"bound_K", row.temperature_bound}, {"time_s", row.processor_time}};
}

/// How wrong T max and the critical gap of the scene as it is may be.
Row facts_of(const AccuracyResult& result, const AccuracyRow& own) {
  Row facts = facts_of(own);
  // Where no error is known: numerics that the reference meshes share and no setting varies.
  for (const std::string& name : result.reference->unvaried) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    facts["unvaried"].push_back(
        fmt::format("{} = {}", name, scene::format_value(key, key.get(result.study.scene.scene))));
  }
  const ReferenceValue& gap = result.reference->critical_gap;
  facts.update(
      {{"limit", std::ranges::all_of(result.reference->temperature,
                                     [](const ReferenceValue& each) { return each.limit.justified; })},
       {"distance_K", own.largest_temperature_error},
       {"gap_cm", shown_gap(own.critical_gap)},
       {"gap_bound_cm", report::number(shown_gap(own.critical_gap_bound))},
       {"gap_limit", gap.limit.justified},
       {"gap_reference_cm", shown_gap(gap.limit.value)},
       {"gap_larger", own.critical_gap_error > 0},
       {"gap_distance_cm", shown_gap(std::abs(own.critical_gap_error))}});
  return facts;
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

Row cheapest_settings(const AccuracyResult& result) {
  Row all = Row::array();
  const AccuracyRow* last = nullptr;
  for (const double tolerance : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const AccuracyRow* row = cheapest_within(result.rows, tolerance);
    if (row == nullptr || row == last) continue;
    last = row;
    all.push_back(facts_of(*row));
    all.back()["tolerance_K"] = tolerance;
  }
  return all;
}

std::string kelvins(double value) { return in_words(value, significant(2, kelvin)); }

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
  const AccuracyRow* own = result.baseline();
  Row facts{{"no_reference", result.reference ? "" : result.no_reference},
            {"unsound", result.reference && own == nullptr},
            {"cheapest", Row::array()}};
  if (result.reference) facts["cheapest"] = cheapest_settings(result);
  if (result.reference && own != nullptr) facts["own"] = facts_of(result, *own);
  const std::string settings = said_below("accuracy.cheapest", facts);
  return fmt::format("{}{}", fmt::join(said("accuracy.answer", facts), "\n"),
                     settings.empty() ? "" : "\nCheapest settings:\n" + settings);
}

Report report_of(const AccuracyResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  if (result.reference) report.draw({"error_against_time.svg", error_plot(result), "error against run time"});
  report.add({setting_table(result), "accuracy.csv", "settings"});
  report.add({reference_table(result), "reference.csv", "reference", Shown::page});
  report.say(said_below("accuracy.files"));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(result.study, report, {{"timing", report::timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
