// The answer, the picture, the page and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::RecordedSetting, study::ReferenceValue;

namespace {

constexpr int first_method = 2;  // colours of methods, from here on

std::string kelvins(double value) { return in_words(value, significant(2, kelvin)); }

Row facts_of(const RecordedSetting& setting) {
  return {
      {"label", setting.label}, {"bound_K", setting.temperature_bound}, {"time_s", setting.processor_time}};
}

/// Processor time of the finest reference mesh over that of the next; 0 where there are not two.
double costs_of_the_finest(const VariantAccuracy& variant) {
  std::vector<double> times;
  for (const AccuracyRow& row : variant.rows)
    if (row.setting.reference && row.computed()) times.push_back(row.setting.processor_time);
  std::ranges::sort(times, std::greater());
  return times.size() < 2 ? 0.0 : times[0] / times[1];
}

/// How wrong T max and the critical gap of the scene as it is may be, and what would halve that.
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
                {"reference_K", variant.reference_uncertainty()},
                {"gap_cm", shown_gap(own.setting.critical_gap)},
                {"gap_bound_cm", report::number(shown_gap(own.setting.critical_gap_bound))},
                {"gap_limit", gap.limit.justified},
                {"gap_reference_cm", shown_gap(gap.limit.value)},
                {"gap_larger", own.critical_gap_error > 0},
                {"gap_distance_cm", shown_gap(std::abs(own.critical_gap_error))}});
  if (const double times = costs_of_the_finest(variant); times > 1.0) facts["finest_times"] = times;
  if (const auto* half = cheapest_within(record, 0.5 * own.setting.temperature_bound)) {
    facts["half"] = facts_of(*half);
    facts["half"]["times"] = half->processor_time / own.setting.processor_time;
  }
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

Row belief_facts(const VariantAccuracy& variant) {
  double inexactness = 0, drift = 0;
  std::size_t justified = 0, sound = 0;
  const std::vector<ReferenceValue>& limits = variant.reference->temperature;
  for (const ReferenceValue& value : limits) {
    justified += value.limit.justified ? 1 : 0;
    inexactness = std::max(inexactness, value.inexactness);
  }
  for (const AccuracyRow& row : variant.rows) {
    if (!row.sound()) continue;
    ++sound;
    drift = std::max(drift, row.answer.run.energy_drift);
  }
  return {{"grids", settings_of<AccuracySettings>(variant.study).reference_cell_sizes.size()},
          {"justified", justified},
          {"gaps", limits.size()},
          {"sound", sound},
          {"settings", variant.rows.size()},
          {"drift_percent", shown_value(drift, significant(2, percent))},
          {"inexactness_K", inexactness}};
}

/// "lab frame": what a setting chooses by a word otherwise than the scene; empty where it chooses nothing.
std::string method_of(const RecordedSetting& setting, const study::Setting& own) {
  for (const auto& [key, value] : setting.setting)
    if (const auto* word = std::get_if<std::string>(&value); word != nullptr && own.at(key) != value)
      return *word + " " + report::plain_words(key);
  return {};
}

/// K: what is nearer than the limit is known to cannot be told from that.
double told_distance(const VariantAccuracy& variant, double distance) {
  const double known_to = variant.reference_uncertainty();
  return distance < known_to ? known_to : distance;
}

/// A logarithmic axis that has room for the values of all panels.
void share_axis(report::PlotAxis Plot::*axis, std::vector<double> Series::*values,
                std::vector<Plot>& panels) {
  constexpr double margin = 1.4;
  double least = HUGE_VAL, most = 0.0;
  for (const Plot& panel : panels)
    for (const Series& series : panel.series) {
      least = std::min(least, std::ranges::min(series.*values) / margin);
      most = std::max(most, std::ranges::max(series.*values) * margin);
    }
  for (Plot& panel : panels) (panel.*axis).minimum = least, (panel.*axis).maximum = most;
}

/// What a variant is: behind the comma of its title, where it has one of its own, or its name.
std::string description_of(const VariantAccuracy& variant, const VariantAccuracy& first) {
  const std::string& title = variant.study.study.title;
  const std::size_t comma = title.find(", ");
  const bool has_own = title != first.study.study.title && comma != std::string::npos;
  return has_own ? title.substr(comma + 2) : variant.name;
}

/// Whether every setting is as near to the limit as that is known.
bool tells_nothing(const Plot& panel) {
  const double known_to = panel.horizontal_bands.empty() ? 0.0 : panel.horizontal_bands.front().to;
  return std::ranges::all_of(panel.series,
                             [=](const Series& each) { return std::ranges::max(each.y) <= known_to; });
}

/// The legend of all panels is that of the plot; a method has one colour in all of them.
void share_legend(Plot& plot) {
  int colour = first_method;
  for (Plot& panel : plot.panels)
    for (Series& each : panel.series) {
      auto entry = std::ranges::find(plot.series, each.label, &Series::label);
      if (entry == plot.series.end()) {
        entry = plot.series.insert(entry, each);
        entry->x = entry->y = {-1.0};  // nowhere
        const bool is_method = entry->mark == Mark::up_triangle || entry->mark == Mark::open_triangle;
        if (is_method) entry->colour = colour++;
      }
      each.colour = entry->colour;
      each.label.clear();
    }
}

/// One panel for each model in which settings differ; nullopt where there is none.
std::optional<Plot> picture_of(const std::vector<const VariantAccuracy*>& variants) {
  Plot plot;
  double largest = 0;  // K, of all variants as the scene has it
  std::vector<std::string> alike;
  for (const VariantAccuracy* each : variants) {
    if (const AccuracyRow* own = each->baseline())
      largest = std::max(largest, told_distance(*each, own->largest_temperature_error));
    Plot panel = error_plot(*each);
    const std::string name = description_of(*each, *variants.front());
    if (variants.size() > 1 && tells_nothing(panel)) {
      alike.push_back(name);
      continue;
    }
    if (variants.size() > 1) panel.title = name + ": " + panel.title;
    plot.panels.push_back(std::move(panel));
  }
  if (plot.panels.empty()) return std::nullopt;
  share_axis(&Plot::x, &Series::x, plot.panels);
  share_axis(&Plot::y, &Series::y, plot.panels);
  if (variants.size() == 1) return std::move(plot.panels.front());
  plot.width = plot.columns * plot.panels.front().width;
  plot.title = fmt::format("As in the scene T max is within {} of its limit, in each of {} models",
                           kelvins(largest), variants.size());
  plot.subtitle = "grey: nearer than the limit is known to; what is there stands at its upper edge";
  if (!alike.empty())
    plot.subtitle += fmt::format("; without a panel, as all settings are: {}", fmt::join(alike, ", "));
  for (Plot& panel : plot.panels)
    for (report::Band& known : panel.horizontal_bands) known = {*panel.y.minimum, known.to};
  share_legend(plot);
  return plot;
}

/// "3 K from its limit": the scene's own setting.
std::string finding_of(const VariantAccuracy& variant) {
  const AccuracyRow* own = variant.baseline();
  if (own == nullptr) return {};
  const double distance = own->largest_temperature_error, told = told_distance(variant, distance);
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
      .height = 440,
      .named_in_place = true};
  const auto points = [](std::string label, int colour, Mark mark) {
    return Series{.label = std::move(label), .style = Style::points, .colour = colour, .mark = mark};
  };
  Series meshes = points("reference meshes", blue, Mark::open_square);
  std::map<std::string, Series> methods{{"", points("other settings", grey, Mark::circle)}};
  const auto add_mark = [&](const AccuracyRow& row, double distance, Series& series) {
    if (std::isfinite(distance)) series.add(row.setting.processor_time, told_distance(variant, distance));
  };
  const study::Setting own_setting = study::setting_of(variant.study.scene.scene);
  const std::vector<double>& times = settings_of<AccuracySettings>(variant.study).times;
  for (const AccuracyRow& row : variant.rows) {
    if (!row.computed() || row.other_model) continue;
    std::string word = method_of(row.setting, own_setting);
    double distance = row.largest_temperature_error;
    // A flame has none, but what the skin would have without reaction.
    const bool ignites = std::isnan(distance) && !row.error_at_times.empty();
    if (ignites) {
      word +=
          fmt::format("{}ignites ({}, no reaction)", word.empty() ? "" : ", ", milliseconds(times.back()));
      distance = std::abs(row.error_at_times.back());
    }
    const Series made = points(word, first_method + static_cast<int>(methods.size()) - 1,
                               ignites ? Mark::open_triangle : Mark::up_triangle);
    Series& method = methods.try_emplace(word, made).first->second;
    if (row.setting.reference || !row.baseline)
      add_mark(row, distance, row.setting.reference ? meshes : method);
  }
  plot.title = (variant.name.empty() ? "As in the scene T max is " : "") + finding_of(variant);
  for (auto& [word, method] : methods) plot.series.push_back(std::move(method));
  plot.series.push_back(std::move(meshes));
  Series& scene = plot.series.emplace_back(points("as in the scene", vermilion, Mark::diamond));
  if (const AccuracyRow* own = variant.baseline()) add_mark(*own, own->largest_temperature_error, scene);
  std::erase_if(plot.series, [](const Series& each) { return each.x.empty(); });
  if (std::isfinite(known_to) && known_to > 0) {
    plot.y.minimum = 0.5 * known_to;
    plot.horizontal_bands = {{*plot.y.minimum, known_to, "limit known to " + kelvins(known_to)}};
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
  std::vector<const VariantAccuracy*> drawn;
  for (const VariantAccuracy& each : result.variants) {
    if (!each.reference) continue;
    drawn.push_back(&each);
    const std::string name = each.name.empty() ? "accuracy.json" : "accuracy_" + each.name + ".json";
    report.files.push_back({name, study::to_json_text(each.record)});
  }
  if (auto picture = picture_of(drawn))
    report.draw({"error_against_time.svg", std::move(*picture), "error against run time"});
  else if (!drawn.empty())
    report.remarks.emplace_back(
        "There is no picture: every setting is as near to the limit as that is known.");
  if (several) report.add({variant_table(result), "variants.csv", "variants"});
  const Shown settings = several ? Shown::file : Shown::page_and_terminal;
  report.add({setting_table(result), "accuracy.csv", "settings", settings});
  report.add({reference_table(result), "reference.csv", "reference", Shown::file});
  report.add({point_table(result), "points.csv", "points", Shown::file});
  report.say(said_below("accuracy.files"));
  if (first.baseline() != nullptr)
    report.say("## Why believe that?\n\n" + said_below("accuracy.belief", belief_facts(first)));
  report.say("## Setup\n\n" + report::setup_text(first.study));
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(result.study, report, {{"timing", report::timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
