// The answer, the picture, the page and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::RecordedSetting, study::ReferenceValue;

namespace {

Row facts_of(const RecordedSetting& setting) {
  return {
      {"label", setting.label}, {"bound_K", setting.temperature_bound}, {"time_s", setting.processor_time}};
}

/// How wrong T max and the critical gap of the scene as it is may be.
Row facts_of(const VariantAccuracy& variant, const AccuracyRow& own) {
  const study::AccuracyRecord& record = variant.record;
  Row facts = facts_of(own.setting);
  // Where no error is known: what the reference meshes share and no setting varies.
  for (const std::string& key : record.unvaried)
    facts["unvaried"].push_back(fmt::format("{} = {}", key,
                                            scene::format_value(*scene::find_key(scene::scene_keys(), key),
                                                                record.settings.front().setting.at(key))));
  const ReferenceValue& gap = variant.reference->critical_gap;
  facts.update({{"limit", !variant.any_indeterminate()},
                {"distance_K", own.largest_temperature_error},
                {"gap_cm", shown_gap(own.setting.critical_gap)},
                {"gap_bound_cm", report::number(shown_gap(own.setting.critical_gap_bound))},
                {"gap_limit", gap.limit.justified},
                {"gap_reference_cm", shown_gap(gap.limit.value)},
                {"gap_larger", own.critical_gap_error > 0},
                {"gap_distance_cm", shown_gap(std::abs(own.critical_gap_error))}});
  return facts;
}

Row cheapest_settings(const study::AccuracyRecord& record) {
  Row all = Row::array();
  const RecordedSetting* last = nullptr;
  for (const double tolerance : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const RecordedSetting* setting = cheapest_within(record, tolerance);
    if (setting == nullptr || setting == last) continue;
    last = setting;
    all.push_back(facts_of(*setting));
    all.back()["tolerance_K"] = tolerance;
  }
  return all;
}

std::string kelvins(double value) { return in_words(value, significant(2, kelvin)); }

/// "3 K from its limit": the scene's own setting. What is nearer than the limit is known to cannot be told
/// from that.
std::string finding_of(const VariantAccuracy& variant) {
  const AccuracyRow* own = variant.baseline();
  if (own == nullptr) return {};
  const double distance = own->largest_temperature_error,
               told = std::max(distance, variant.reference_uncertainty());
  return (distance < told ? "within " : "") + kelvins(told) +
         (distance < told ? " of its limit" : " from its limit");
}

}  // namespace

Plot error_plot(const VariantAccuracy& variant) {
  constexpr int blue = 0, vermilion = 1, grey = 7;
  const double known_to = variant.reference_uncertainty();
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
    if (std::isfinite(distance)) series.add(row.setting.processor_time, std::max(distance, known_to));
  };
  for (const AccuracyRow& row : variant.rows)
    if (row.computed() && !row.other_model && (row.setting.reference || !row.baseline))
      add_mark(row, row.largest_temperature_error, row.setting.reference ? meshes : others);
  plot.title =
      (variant.name.empty() ? "As in the scene T max is " : variant.name + ": ") + finding_of(variant);
  plot.series = {std::move(others), std::move(meshes)};
  Series& scene = plot.series.emplace_back(points("as in the scene", vermilion, Mark::diamond));
  if (const AccuracyRow* own = variant.baseline()) add_mark(*own, own->largest_temperature_error, scene);
  std::erase_if(plot.series, [](const Series& each) { return each.x.empty(); });
  if (std::isfinite(known_to) && known_to > 0) {
    plot.y.minimum = 0.5 * known_to;
    plot.subtitle = "the limit is known to " + kelvins(known_to);
  }
  if (!variant.record.unvaried.empty())
    plot.subtitle = "no bound of the error is known: the reference itself may be off";
  return plot;
}

std::string answer(const AccuracyResult& result) {
  const VariantAccuracy& first = result.variants.front();
  const std::string of = first.name.empty() ? "" : fmt::format("Variant {}: ", first.name);
  const AccuracyRow* own = first.baseline();
  Row facts{{"no_reference", first.reference ? "" : first.no_reference},
            {"unsound", first.reference && own == nullptr},
            {"cheapest", Row::array()}};
  if (first.reference) facts["cheapest"] = cheapest_settings(first.record);
  if (first.reference && own != nullptr) facts["own"] = facts_of(first, *own);
  const std::string settings = said_below("accuracy.cheapest", facts);
  return fmt::format("{}{}{}", of, fmt::join(said("accuracy.answer", facts), "\n"),
                     settings.empty() ? "" : "\nCheapest settings:\n" + settings);
}

Report report_of(const AccuracyResult& result) {
  const VariantAccuracy& first = result.variants.front();
  const bool several = result.variants.size() > 1;
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  for (const VariantAccuracy& each : result.variants) {
    if (!each.reference) continue;
    const std::string of = each.name.empty() ? "" : "_" + each.name;
    report.files.push_back({fmt::format("accuracy{}.json", of), study::to_json_text(each.record)});
    report.draw({fmt::format("error_against_time{}.svg", of), error_plot(each), "error against run time"});
  }
  if (several) report.add({variant_table(result), "variants.csv", "variants"});
  const Shown settings = several ? Shown::file : Shown::page_and_terminal;
  report.add({setting_table(result), "accuracy.csv", "settings", settings});
  report.add({reference_table(result), "reference.csv", "reference", Shown::file});
  report.say(said_below("accuracy.files"));
  report.say("## Setup\n\n" + report::setup_text(first.study));
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(result.study, report, {{"timing", report::timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
