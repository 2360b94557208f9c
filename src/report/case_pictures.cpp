#include "launchsafe/report/case_pictures.hpp"

#include "case_pictures_parts.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace detail {
namespace {

struct EnergyTerm {
  const char* name;
  double run::EnergyBalance::*value;
};

/// The magnitudes of terms against time.
Plot energy_plot(const DrawnCase& drawn, const char* what, const std::vector<EnergyTerm>& terms) {
  const bool whole = drawn.scene.symmetry == scene::Symmetry::axisymmetric;
  Plot plot = time_plot(
      drawn, what, whole ? "energy, magnitude [J]" : "energy per metre of the half model, magnitude [J]");
  plot.y.scale = Scale::logarithmic;
  for (const EnergyTerm& term : terms) {
    Series& series = plot.series.emplace_back(Series{.label = term.name});
    for (const run::MonitorSample& sample : drawn.result.mechanics.monitor)
      series.add(1e3 * sample.time, std::abs(sample.energy.*term.value));
  }
  // What is smaller is round-off beside the largest term.
  constexpr double smallest = 1e-8;
  const auto highest = [](const Series& series) {
    return series.y.empty() ? 0.0 : *std::max_element(series.y.begin(), series.y.end());
  };
  double largest = 0.0;
  for (const Series& series : plot.series) largest = std::max(largest, highest(series));
  std::erase_if(plot.series, [&](const Series& series) { return !(highest(series) > smallest * largest); });
  // Every other one is dashed, so that terms which balance each other are both seen.
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    plot.series[i].style = i % 2 == 0 ? Style::line : Style::dashed_line;
  if (largest > 0.0) plot.y.minimum = smallest * largest;
  return plot;
}

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

}  // namespace

std::string shortened(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  // Not within a character of several bytes.
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

Plot titled_plot(const DrawnCase& drawn, std::string title) {
  Plot plot;
  plot.title = std::move(title);
  plot.subtitle = shortened(drawn.scene.title, 100);
  return plot;
}

std::vector<double> milliseconds_of(const std::vector<double>& seconds) {
  std::vector<double> values;
  values.reserve(seconds.size());
  for (const double time : seconds) values.push_back(1e3 * time);
  return values;
}

Plot time_plot(const DrawnCase& drawn, std::string title, std::string quantity) {
  Plot plot = titled_plot(drawn, std::move(title));
  plot.x.label = "time [ms]";
  plot.y.label = std::move(quantity);
  return plot;
}

Series time_series(const char* label, const std::vector<double>& time, const std::vector<double>& values,
                   double factor) {
  Series series{.label = label, .x = milliseconds_of(time), .y = values, .style = Style::line};
  for (double& value : series.y) value *= factor;
  return series;
}

std::string lacks_pressure(const DrawnCase& drawn) {
  return drawn.result.mechanics.trace.samples() > 1 ? "" : "its trace has no samples";
}

std::vector<CasePicture> pressure_pictures(const DrawnCase& drawn) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  Plot plot = time_plot(drawn, "Pressures", "pressure [MPa]");
  plot.series = {time_series("chamber, on the base", trace.time, trace.chamber_pressure, 1e-6),
                 time_series("charge's bottom, area mean", trace.time, trace.bottom_pressure, 1e-6)};
  return {{"pressure.svg", std::move(plot)}};
}

std::vector<CaseTable> pressure_tables(const DrawnCase& drawn) {
  const trace::BottomTrace& trace = drawn.result.mechanics.trace;
  Table table{.columns = {{"time", "ms"}, {"chamber", "MPa"}, {"bottom", "MPa"}}};
  for (std::size_t i = 0; i < trace.samples(); ++i)
    table.rows.push_back(
        {1e3 * trace.time[i], 1e-6 * trace.chamber_pressure[i], 1e-6 * trace.bottom_pressure[i]});
  return {{"pressure.csv", std::move(table)}};
}

std::string lacks_energy(const DrawnCase& drawn) {
  const auto& monitor = drawn.result.mechanics.monitor;
  const bool moves = std::any_of(monitor.begin(), monitor.end(), [](const run::MonitorSample& sample) {
    return sample.energy.external != 0.0 || sample.energy.kinetic != 0.0;
  });
  return moves ? "" : "its monitor recorded no energies";
}

std::vector<CasePicture> energy_pictures(const DrawnCase& drawn) {
  using run::EnergyBalance;
  std::vector<CasePicture> pictures;
  pictures.push_back(
      {"energy.svg", energy_plot(drawn, "Terms of the energy balance",
                                 {{"work of the chamber pressure", &EnergyBalance::external},
                                  {"internal", &EnergyBalance::internal},
                                  {"work of the frame's body force", &EnergyBalance::body_force},
                                  {"kinetic, relative to the frame", &EnergyBalance::kinetic},
                                  {"taken out by damping", &EnergyBalance::damping},
                                  {"taken out by contact", &EnergyBalance::contact}})});
  Plot losses = energy_plot(drawn, "Dissipated and stored parts of the internal energy",
                            {{"plastic, in steel", &EnergyBalance::plastic},
                             {"viscous, in the charge", &EnergyBalance::viscous},
                             {"crack growth, in the charge", &EnergyBalance::crack},
                             {"stored against hourglassing", &EnergyBalance::hourglass}});
  if (!losses.series.empty()) pictures.push_back({"energy_dissipated.svg", std::move(losses)});
  return pictures;
}

}  // namespace detail

const std::vector<PictureKind>& picture_kinds() {
  static const std::vector<PictureKind> kinds{
      {"pressure", "chamber and bottom pressure against time", detail::lacks_pressure,
       detail::pressure_pictures, detail::pressure_tables},
      detail::fields_kind,
      detail::histories_kind,
      detail::profile_kind,
      detail::air_kind,
      {"energy", "terms of the energy balance against time", detail::lacks_energy, detail::energy_pictures},
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

store::Result<std::string> to_svg(const CasePicture& picture, const DrawingLimits& limits) {
  return std::visit([&](const auto& plot) { return to_svg(plot, "gnuplot", limits); }, picture.plot);
}

}  // namespace launchsafe::report
