// The picture of page one: T max of a launch against gap, by its verdicts.
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::report {
namespace {

constexpr int blue = 0, vermilion = 1, green = 2, orange = 4, black = 6;

bool ignites(const Row& verdict) { return !text_of(verdict, "ignition_cause").empty(); }

/// Gaps of one verdict that do not ignite, with their uncertainty. Nothing is colder than the launch began
/// (K). A bar whose end is not known goes on.
Series judged_series(const Row& verdicts, const std::string& word, const std::string& label, int colour,
                     double initial) {
  Series series{.label = label, .style = Style::vertical_bars, .colour = colour, .mark = Mark::circle};
  for (const Row& row : verdicts) {
    const double temperature = number_of(row, "temperature_max_K"),
                 uncertainty = number_of(row, "uncertainty_K");
    if (text_of(row, "verdict") != word || ignites(row) || !std::isfinite(temperature)) continue;
    const bool known = std::isfinite(uncertainty);
    series.add(number_of(row, quantity::gap.key()), temperature,
               known ? std::max(temperature - uncertainty, initial) : temperature,
               known ? temperature + uncertainty : math::infinity);
  }
  return series;
}

Series points_of(const Row& rows, const char* temperature, Series look) {
  look.style = Style::points;
  for (const Row& row : rows)
    if (const double value = number_of(row, temperature); std::isfinite(value))
      look.add(number_of(row, quantity::gap.key()), value);
  return look;
}

/// "SAFE up to 0.01 cm; critical gap 0.038 +0.010 −0.011 cm".
std::string finding_of(const Row& critical, const std::string& safe) {
  const double largest = number_of(critical, "largest_safe_gap_cm");
  return fmt::format("{}; critical gap {}",
                     std::isnan(largest) ? "No computed gap is SAFE"
                                         : fmt::format("{}{} up to {} cm", safe,
                                                       safe.find(',') == std::string::npos ? "" : ",",
                                                       significant(largest, 6)),
                     text_of(critical, "critical_gap_with_bounds"));
}

/// With its bounds; where these go far beyond all other gaps the axis ends before, and words say where they
/// do.
void add_critical_gap(const Row& critical, Plot& plot) {
  const double value = number_of(critical, "critical_gap_cm"),
               at_least = number_of(critical, "critical_gap_at_least_cm"),
               at_most = number_of(critical, "critical_gap_at_most_cm");
  if (!std::isfinite(value)) return;
  plot.vertical_lines = {{value, "critical gap"}};
  if (!std::isfinite(at_least) || !std::isfinite(at_most)) return;
  const Band& bounds =
      plot.vertical_bands.emplace_back(Band{at_least, at_most, "bounds of the critical gap"});
  double largest = value;
  for (const Series& series : plot.series) largest = std::max(largest, std::ranges::max(series.x));
  if (bounds.to <= 1.3 * largest) return;
  plot.x.maximum = 1.3 * largest;
  plot.subtitle +=
      fmt::format("{}the bounds of the critical gap go on to {} cm", plot.subtitle.empty() ? "" : "; ",
                  shown_digits(bounds.to, quantity::upper_bound.form));
}

}  // namespace

Plot verdict_plot(const Row& tables, const scene::Scene& scene) {
  const double initial = scene.initial_temperature, ignition = scene.charge().kinetics.ignition_temperature;
  const Row &verdicts = found_in(tables, "verdicts"), &critical = found_in(tables, "cases").front();
  const bool is_green = text_of(critical, "accepted").empty();
  // A picture may be shown without its page.
  const std::string safe = is_green ? "SAFE" : "SAFE, as somebody accepts";
  Plot plot{.title = finding_of(critical, safe),
            .x = {.label = quantity::gap.label()},
            .y = {.label = quantity::temperature_max.label()},
            .width = 1100,
            .height = 335};
  Row ignited = verdicts;
  std::erase_if(ignited.get_ref<Row::array_t&>(), [](const Row& row) { return !ignites(row); });
  for (Series& series :
       std::array{judged_series(verdicts, "SAFE", safe, is_green ? green : blue, initial),
                  judged_series(verdicts, "INDETERMINATE", "INDETERMINATE", orange, initial),
                  points_of(ignited, "temperature_max_K",
                            {.label = "UNSAFE: ignites", .colour = vermilion, .mark = Mark::cross}),
                  points_of(found_in(tables, "comparison"), "temperature_max_published_K",
                            {.label = "published, " + scene::time_text(scene::read_time(scene.load)),
                            .colour = black,
                            .mark = Mark::open_square})})
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  cut_axis(ignition, plot);
  add_critical_gap(critical, plot);
  plot.horizontal_lines = {{ignition, "ignition at " + significant(ignition, 4) + " K"}};
  return plot;
}

}  // namespace launchsafe::report
