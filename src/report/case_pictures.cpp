#include "case_pictures_parts.hpp"

namespace launchsafe::report {
namespace detail {
namespace {

/// Adds those of a run, each instant once. A time that the scene asks for is that of the first snapshot which
/// is not before it.
void add_shown(const DrawnCase& drawn, const std::vector<run::Snapshot>& snapshots, std::optional<double> gap,
               std::vector<ShownSnapshot>& shown) {
  constexpr double round_off = 1e-9;
  double before = -1.0;  // s
  for (const run::Snapshot& shot : snapshots) {
    if (shot.time == before) continue;
    ShownSnapshot& each = shown.emplace_back(ShownSnapshot{&shot, {}, gap});
    const double latest = shot.time * (1.0 + round_off);
    for (const double time : drawn.scene.output.snapshot_times)
      if (time > before * (1.0 + round_off) && time <= latest)
        each.asked_for = std::max(time, each.asked_for.value_or(0.0));
    before = shot.time;
  }
}

std::vector<Picture> pressure_pictures(const DrawnCase& drawn) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  const auto highest = [](const std::vector<double>& pressure) {
    return in_words(std::ranges::max(pressure), significant(3, megapascal));
  };
  Plot plot = load_plot(drawn);
  plot.title = fmt::format("The chamber reaches {}, the charge's bottom {}", highest(trace.chamber_pressure),
                           highest(trace.bottom_pressure));
  return {{"pressure.svg", std::move(plot)}};
}

std::vector<ReportTable> pressure_tables(const DrawnCase& drawn) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  return {{sample_table({{drawn_time(), at_sample(trace.time)},
                         {"chamber", "chamber", keys::significant(6, megapascal),
                          "Mean pressure of the chamber on the base.", at_sample(trace.chamber_pressure)},
                         {"bottom", "bottom", keys::significant(6, megapascal),
                          "Mean pressure of the charge's bottom.", at_sample(trace.bottom_pressure)}},
                        trace.samples()),
           "pressure.csv"}};
}

}  // namespace

Plot titled_plot(const DrawnCase& drawn, std::string title) {
  Plot plot;
  plot.title = std::move(title);
  plot.subtitle = drawn.scene.title;
  return plot;
}

std::vector<double> shown_values(const std::vector<double>& values, const Column& quantity) {
  return study::of_each(values, [&](double value) { return shown_value(value, quantity.form); });
}

Column drawn_time() { return quantity::time(4); }

Plot time_plot(const DrawnCase& drawn, std::string title, std::string quantity) {
  Plot plot = titled_plot(drawn, std::move(title));
  plot.x.label = drawn_time().label();
  plot.y.label = std::move(quantity);
  return plot;
}

Plot load_plot(const DrawnCase& drawn) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  Plot plot = time_plot(drawn, {}, quantity::pressure.label());
  plot.series = {time_series("chamber", trace.time, trace.chamber_pressure, quantity::pressure),
                 time_series("charge's bottom", trace.time, trace.bottom_pressure, quantity::pressure)};
  // Of stations no line has these colours, beside which they are drawn.
  plot.series[0].colour = 5, plot.series[1].colour = 4;
  return plot;
}

Series time_series(std::string label, const std::vector<double>& time, const std::vector<double>& values,
                   const Column& quantity) {
  return {.label = std::move(label),
          .x = shown_values(time, drawn_time()),
          .y = shown_values(values, quantity),
          .style = Style::line};
}

Table sample_table(const Quantities<std::size_t>& quantities, std::size_t samples) {
  std::vector<std::size_t> rows(samples);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return table_of({}, quantities, rows);
}

}  // namespace detail

const std::vector<PictureKind>& picture_kinds() {
  static const std::vector<PictureKind> kinds{
      {"pressure", "chamber and bottom pressure against time",
       [](const DrawnCase& drawn) -> std::string {
         return drawn.result.mechanics.trace.samples() > 1 ? "" : "its trace has no samples";
       },
       detail::pressure_pictures, detail::pressure_tables},
      detail::fields_kind,
      detail::histories_kind,
      detail::profile_kind,
      detail::combustion_kind,
  };
  return kinds;
}

std::vector<ShownSnapshot> shown_snapshots(const DrawnCase& drawn) {
  std::vector<ShownSnapshot> shown;
  detail::add_shown(drawn, drawn.result.mechanics.snapshots, {}, shown);
  for (const run::GapResult& gap : drawn.result.gaps)
    if (gap.combustion) detail::add_shown(drawn, gap.combustion->snapshots, gap.gap, shown);
  return shown;
}

bool is_of_time(const ShownSnapshot& snapshot, double time) {
  return std::abs(snapshot.time() - time) <= 1e-6 * std::abs(time);
}

}  // namespace launchsafe::report
