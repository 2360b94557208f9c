// Skin temperatures along the charge's bottom, the gap's air, and what burns.
#include "case_pictures_parts.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace launchsafe::report::detail {
namespace {

const trace::BottomTrace& trace_of(const DrawnCase& drawn) { return drawn.result.mechanics.trace; }

bool has_skin(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.skin.time.size() > 1 && !rings_of(trace_of(drawn)).empty() &&
         gap.skin.temperature.size() == gap.skin.time.size() * trace_of(drawn).stations.size();
}

/// The gaps of a case that hold what a kind of pictures needs.
std::vector<const run::GapResult*> gaps_with(bool (*what)(const DrawnCase&, const run::GapResult&),
                                             const DrawnCase& drawn) {
  std::vector<const run::GapResult*> gaps;
  for (const run::GapResult& gap : drawn.result.gaps)
    if (what(drawn, gap)) gaps.push_back(&gap);
  return gaps;
}

/// Samples before the ignition, all without one.
std::size_t samples_before_ignition(const surface::SkinHistory& skin) {
  if (!skin.ignition) return skin.time.size();
  return static_cast<std::size_t>(std::lower_bound(skin.time.begin(), skin.time.end(), skin.ignition->time) -
                                  skin.time.begin());
}

std::vector<Line> ignition_line(const DrawnCase& drawn, const run::GapResult& gap) {
  if (!gap.skin.ignition) return {};
  const surface::Ignition& ignition = *gap.skin.ignition;
  return {{shown_value(ignition.time, drawn_time().form),
           fmt::format("ignition at {}, {}", trace_of(drawn).stations[ignition.station].name,
                       in_words(ignition.time, quantity::ignition_time().form))}};
}

std::string gap_title(const char* what, const run::GapResult& gap) {
  return fmt::format("{}, gap {}", what, centimetres(gap.gap));
}

/// A quantity of one gap against time.
Plot gap_plot(const DrawnCase& drawn, const run::GapResult& gap, const char* what,
              const std::string& quantity) {
  Plot plot = time_plot(drawn, gap_title(what, gap), quantity);
  plot.vertical_lines = ignition_line(drawn, gap);
  return plot;
}

/// "histories_0.04cm.svg".
CasePicture picture_of_gap(const char* name, const run::GapResult& gap, Plot plot) {
  return {fmt::format("{}_{}.svg", name, gap_in_name(gap.gap)), std::move(plot), {}, gap.gap};
}

// --- profiles ---

Column distance_from_axis() {
  return {"r", "distance from the axis, r", keys::significant(4, millimetre), "Distance from the axis."};
}

std::vector<double> profile_times(const DrawnCase& drawn) {
  if (!drawn.times.empty()) return drawn.times;
  constexpr int parts = 6;
  std::vector<double> times;
  for (int i = 1; i <= parts; ++i) times.push_back(trace_of(drawn).time.back() * i / parts);
  return times;
}

std::vector<double> temperatures_of(const surface::SkinHistory& skin, std::size_t station,
                                    std::size_t stations) {
  std::vector<double> values;
  for (std::size_t sample = 0; sample < skin.time.size(); ++sample)
    values.push_back(skin.temperature[sample * stations + station]);
  return values;
}

Plot profile_plot(const DrawnCase& drawn, const run::GapResult& gap) {
  const trace::BottomTrace& trace = trace_of(drawn);
  Plot plot = titled_plot(drawn, gap_title("Skin temperature along the bottom", gap));
  plot.x = {.label = distance_from_axis().label(), .minimum = 0.0};
  plot.y.label = quantity::skin_temperature().label();
  const std::vector<double> times = profile_times(drawn);
  for (const double time : times)
    plot.series.push_back({.label = in_words(time, quantity::time_in_titles())});
  for (const std::size_t ring : rings_of(trace)) {
    const std::vector<double> history = temperatures_of(gap.skin, ring, trace.stations.size());
    for (std::size_t i = 0; i < times.size(); ++i)
      plot.series[i].add(shown_value(trace.stations[ring].r, distance_from_axis().form),
                         trace::interpolate(gap.skin.time, history, times[i]));
  }
  return plot;
}

/// Highest less lowest temperature of the stations, until ignition.
Series spread_series(const DrawnCase& drawn, const run::GapResult& gap) {
  const trace::BottomTrace& trace = trace_of(drawn);
  const std::size_t samples = samples_before_ignition(gap.skin);
  Series series{.label = centimetres(gap.gap) + (gap.skin.ignition ? ", until ignition" : ""),
                .style = Style::line};
  for (std::size_t sample = 0; sample < samples; ++sample) {
    double lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (const std::size_t ring : rings_of(trace)) {
      const double temperature = gap.skin.temperature[sample * trace.stations.size() + ring];
      lowest = std::min(lowest, temperature);
      highest = std::max(highest, temperature);
    }
    series.add(shown_value(gap.skin.time[sample], drawn_time().form), highest - lowest);
  }
  return series;
}

Plot spread_plot(const DrawnCase& drawn) {
  Plot plot = time_plot(drawn, "Temperature difference along the bottom",
                        headed("highest less lowest skin temperature", quantity::skin_temperature()));
  for (const run::GapResult* gap : gaps_with(has_skin, drawn))
    plot.series.push_back(spread_series(drawn, *gap));
  return plot;
}

// --- air ---

/// The air of a gap at the highest pressure before ignition.
struct AirState {
  double compression = 1;  ///< density over that at first
  double temperature = 0;  ///< K
  double pressure = 0;     ///< Pa
};

AirState reached_state(const DrawnCase& drawn, const run::GapResult& gap) {
  const scene::Surface& surface = drawn.scene.surface;
  const bool chamber = surface.air_pressure == scene::AirPressure::chamber;
  const auto& pressure = chamber ? trace_of(drawn).chamber_pressure : trace_of(drawn).bottom_pressure;
  const auto end = pressure.begin() +
                   static_cast<std::ptrdiff_t>(std::max<std::size_t>(samples_before_ignition(gap.skin), 1));
  const auto highest = std::max_element(pressure.begin(), end);
  const double temperature = gap.skin.air_temperature[static_cast<std::size_t>(highest - pressure.begin())];
  const double ratio =
      *highest / surface.air.initial_pressure * surface.air.initial_temperature / temperature;
  return {std::max(ratio, 1.0), temperature, *highest};
}

bool has_air(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.gap > 0.0 && has_skin(drawn, gap) && gap.skin.air_temperature.size() == gap.skin.time.size() &&
         trace_of(drawn).bottom_pressure.size() == gap.skin.time.size() &&
         trace_of(drawn).chamber_pressure.size() == gap.skin.time.size();
}

/// "gap 0.02 cm", "gaps 0.01 to 0.04 cm" or "every gap".
std::string gaps_text(const std::vector<std::string>& gaps, bool all) {
  if (gaps.size() == 1) return fmt::format("gap {} cm", gaps.front());
  return all ? "every gap" : fmt::format("gaps {} to {} cm", gaps.front(), gaps.back());
}

bool has_closed(const DrawnCase&, const run::GapResult& gap) {
  return gap.closing && gap.closing->time.size() > 1 &&
         gap.skin.air_temperature.size() == gap.closing->time.size();
}

/// One mark for all gaps whose air reached the same state.
std::vector<Series> reached_series(const DrawnCase& drawn) {
  struct Reached {
    AirState state;
    std::vector<std::string> gaps;
  };
  std::vector<Reached> all;
  for (const run::GapResult* gap : gaps_with(has_air, drawn)) {
    const AirState state = reached_state(drawn, *gap);
    const auto same = std::find_if(all.begin(), all.end(), [&](const Reached& each) {
      return std::abs(each.state.temperature - state.temperature) < 0.05 &&
             std::abs(each.state.pressure - state.pressure) < 1e-3 * state.pressure;
    });
    Reached& reached = same != all.end() ? *same : all.emplace_back(Reached{state, {}});
    reached.gaps.push_back(digits_of(gap->gap, quantity::gap().form));
  }
  std::vector<Series> series;
  for (const Reached& each : all)
    series.push_back({.label = fmt::format("{}: {} at {}", gaps_text(each.gaps, all.size() == 1),
                                           in_words(each.state.temperature, keys::fixed(0, kelvin)),
                                           in_words(each.state.pressure, keys::significant(4, megapascal))),
                      .x = {each.state.compression},
                      .y = {each.state.temperature},
                      .style = Style::points});
  return series;
}

Series adiabat(const materials::AirParameters& air, double highest_ratio) {
  constexpr int points = 200;
  Series series{.label = fmt::format("adiabat, heat ratio {}", significant(air.heat_ratio, 4)),
                .style = Style::line,
                .colour = 7};
  for (int i = 0; i <= points; ++i) {
    const double ratio = 1.0 + (highest_ratio - 1.0) * i / points;
    series.add(ratio, air.initial_temperature * std::pow(ratio, air.heat_ratio - 1.0));
  }
  return series;
}

// --- combustion ---

void add_combustion(const DrawnCase& drawn, const run::GapResult& gap, std::vector<CasePicture>& pictures) {
  const run::CombustionHistory& history = *gap.combustion;
  const bool whole = drawn.scene.symmetry == scene::Symmetry::axisymmetric;
  const Column burnt = headed(whole ? "burnt mass" : "burnt mass per metre", quantity::burnt_mass());
  Plot mass = gap_plot(drawn, gap, "Burnt mass", burnt.label());
  mass.series = {time_series("burnt mass", history.time, history.burnt_mass, burnt)};
  Plot pressure = gap_plot(drawn, gap, "Pressure while it burns", quantity::pressure().label());
  pressure.series = {
      time_series("mean over the charge's bottom", history.time, history.pressure, quantity::pressure())};
  Plot degree = gap_plot(drawn, gap, "Reaction of the skin", "reaction degree of the skin [1]");
  const std::size_t stations = trace_of(drawn).stations.size();
  const auto value = [&](std::size_t sample, std::size_t station) {
    return history.reaction_degree[sample * stations + station];
  };
  degree.series = station_series(trace_of(drawn), shown_values(history.time, drawn_time()), value,
                                 gap.skin.ignition ? gap.skin.ignition->station : stations);
  pictures.push_back(picture_of_gap("combustion_mass", gap, std::move(mass)));
  pictures.push_back(picture_of_gap("combustion_pressure", gap, std::move(pressure)));
  pictures.push_back(picture_of_gap("combustion_reaction", gap, std::move(degree)));
}

bool has_combustion(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.combustion && gap.combustion->samples() > 1 && !rings_of(trace_of(drawn)).empty() &&
         gap.combustion->reaction_degree.size() ==
             gap.combustion->samples() * trace_of(drawn).stations.size();
}

}  // namespace

std::string gap_in_name(double gap) {
  const Form form = quantity::gap().form;
  return digits_of(gap, form) + form.unit;
}

std::vector<std::size_t> rings_of(const trace::BottomTrace& trace) {
  std::vector<std::size_t> rings;
  for (std::size_t i = 0; i < trace.stations.size(); ++i)
    if (!trace.stations[i].observation) rings.push_back(i);
  std::stable_sort(rings.begin(), rings.end(),
                   [&](std::size_t a, std::size_t b) { return trace.stations[a].r < trace.stations[b].r; });
  return rings;
}

std::vector<Series> station_series(const trace::BottomTrace& trace, const std::vector<double>& x,
                                   const std::function<double(std::size_t, std::size_t)>& value,
                                   std::size_t marked) {
  constexpr int grey = 7;
  const std::vector<std::size_t> rings = rings_of(trace);
  std::vector<Series> background, named;
  for (const std::size_t ring : rings) {
    const trace::Station& station = trace.stations[ring];
    Series series{.x = x, .style = Style::line, .colour = grey};
    for (std::size_t sample = 0; sample < x.size(); ++sample) series.y.push_back(value(sample, ring));
    const bool is_named =
        ring == rings.front() || ring == rings.back() || ring == rings[rings.size() / 2] || ring == marked;
    if (!is_named) {
      background.push_back(std::move(series));
      continue;
    }
    series.label =
        fmt::format("{}, r {}", station.name, in_words(station.r, keys::significant(4, millimetre)));
    series.colour = static_cast<int>(named.size());
    named.push_back(std::move(series));
  }
  if (!background.empty()) background.front().label = "stations between";
  background.insert(background.end(), named.begin(), named.end());
  return background;
}

namespace {

std::string lacks_skins(const DrawnCase& drawn) {
  return gaps_with(has_skin, drawn).empty() ? "it holds no skin temperatures of any gap" : "";
}

std::vector<CasePicture> history_pictures(const DrawnCase& drawn) {
  std::vector<CasePicture> pictures;
  const std::size_t stations = trace_of(drawn).stations.size();
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    Plot plot = gap_plot(drawn, *gap, "Skin temperatures", quantity::skin_temperature().label());
    plot.series = station_series(
        trace_of(drawn), shown_values(skin.time, drawn_time()),
        [&](std::size_t sample, std::size_t station) {
          return skin.temperature[sample * stations + station];
        },
        gap->at_stations.station);
    pictures.push_back(picture_of_gap("histories", *gap, std::move(plot)));
  }
  return pictures;
}

std::vector<CaseTable> history_tables(const DrawnCase& drawn) {
  const std::vector<trace::Station>& stations = trace_of(drawn).stations;
  std::vector<CaseTable> tables;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    Quantities<std::size_t> quantities{
        {drawn_time(), [&skin](std::size_t sample) { return skin.time[sample]; }}};
    for (std::size_t i = 0; i < stations.size(); ++i)
      quantities.emplace_back(
          named(stations[i].name, headed(stations[i].name, always(quantity::skin_temperature()))),
          [&skin, i, count = stations.size()](std::size_t sample) {
            return skin.temperature[sample * count + i];
          });
    std::vector<std::size_t> samples(skin.time.size());
    std::iota(samples.begin(), samples.end(), std::size_t{0});
    tables.push_back(
        {fmt::format("histories_{}.csv", gap_in_name(gap->gap)), table_of({}, quantities, samples)});
  }
  return tables;
}

std::vector<CasePicture> profile_pictures(const DrawnCase& drawn) {
  std::vector<CasePicture> pictures;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn))
    pictures.push_back(picture_of_gap("profile", *gap, profile_plot(drawn, *gap)));
  pictures.push_back({"profile_spread.svg", spread_plot(drawn)});
  return pictures;
}

/// Of gaps that close, against time: what they are at, and what their air has.
std::vector<CasePicture> closing_pictures(const DrawnCase& drawn) {
  const Column opening{"opening", "mean opening", significant(4, micrometre), "Mean opening of the gap."};
  const Column temperature = headed("mean air temperature", quantity::skin_temperature());
  std::vector<CasePicture> pictures;
  for (const run::GapResult* gap : gaps_with(has_closed, drawn)) {
    const run::ClosingHistory& closing = *gap->closing;
    const auto panel = [&](const char* what, const Column& quantity, const std::vector<double>& values) {
      Plot plot = gap_plot(drawn, *gap, what, quantity.label());
      plot.series = {time_series("", closing.time, values, quantity)};
      if (std::isfinite(closing.contact_time))
        plot.vertical_lines.push_back(
            {shown_value(closing.contact_time, drawn_time().form),
             "first contact at " + in_words(closing.contact_time, drawn_time().form)});
      return plot;
    };
    Plot plot = titled_plot(drawn, gap_title("The closing gap and its air", *gap));
    plot.panels = {panel("Opening", opening, closing.opening),
                   panel("Pressure of the air", quantity::pressure(), closing.gas_pressure),
                   panel("Temperature of the air", temperature, gap->skin.air_temperature)};
    plot.panels[0].y.scale = plot.panels[1].y.scale = Scale::logarithmic;
    pictures.push_back(picture_of_gap("air", *gap, std::move(plot)));
  }
  return pictures;
}

std::string lacks_air(const DrawnCase& drawn) {
  if (drawn.scene.surface.model == scene::GapModel::closing)
    return gaps_with(has_closed, drawn).empty() ? "none of its gaps closed" : "";
  return gaps_with(has_air, drawn).empty() ? "it holds no gap with air" : "";
}

std::vector<CasePicture> air_pictures(const DrawnCase& drawn) {
  const scene::Surface& surface = drawn.scene.surface;
  if (surface.model == scene::GapModel::closing) return closing_pictures(drawn);
  const std::vector<Series> reached = reached_series(drawn);
  double highest = 1.0;
  for (const Series& series : reached) highest = std::max(highest, series.x.front());
  // The reservoir's state follows from the pressure alone: one mark stands for every gap.
  Plot plot = titled_plot(drawn, surface.air_model == scene::AirModel::reservoir
                                     ? "Air at the highest pressure, on its adiabat whatever the gap"
                                     : "Air at the highest pressure");
  plot.x.label = "compression, density over initial density [1]";
  plot.y.label = headed("air temperature", quantity::skin_temperature()).label();
  plot.series = {adiabat(surface.air, 1.05 * highest)};
  plot.series.insert(plot.series.end(), reached.begin(), reached.end());
  return {{"air.svg", std::move(plot)}};
}

std::string lacks_combustion(const DrawnCase& drawn) {
  return gaps_with(has_combustion, drawn).empty() ? "no gap of it ignited in a run with two-way coupling"
                                                  : "";
}

std::vector<CasePicture> combustion_pictures(const DrawnCase& drawn) {
  std::vector<CasePicture> pictures;
  for (const run::GapResult* gap : gaps_with(has_combustion, drawn)) add_combustion(drawn, *gap, pictures);
  return pictures;
}

}  // namespace

const PictureKind histories_kind{"histories", "skin temperature of the stations against time, for each gap",
                                 lacks_skins, history_pictures, history_tables};
const PictureKind profile_kind{"profile",
                               "skin temperature along the bottom at several times, and its spread over time",
                               lacks_skins, profile_pictures};
const PictureKind air_kind{"air",
                           "air temperature against compression, with the states reached; opening, pressure "
                           "and temperature against time where a gap closes",
                           lacks_air, air_pictures};
const PictureKind combustion_kind{"combustion", "burnt mass, pressure and reaction degree after ignition",
                                  lacks_combustion, combustion_pictures};

}  // namespace launchsafe::report::detail
