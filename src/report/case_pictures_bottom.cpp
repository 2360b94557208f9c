// Skin temperatures along the charge's bottom, and what burns.
#include "case_pictures_parts.hpp"
#include "launchsafe/study/rows.hpp"

namespace launchsafe::report::detail {
namespace {

const trace::BottomTrace& trace_of(const DrawnCase& drawn) { return drawn.result.mechanics.trace; }

/// Samples before the ignition, all without one.
std::size_t samples_before_ignition(const surface::SkinHistory& skin) {
  if (!skin.ignition) return skin.time.size();
  return static_cast<std::size_t>(std::ranges::lower_bound(skin.time, skin.ignition->time) -
                                  skin.time.begin());
}

std::string station_name(const trace::Station& station) {
  return fmt::format("{}, r {}", station.name, in_words(station.r, keys::significant(4, millimetre)));
}

/// Values of all stations sample after sample, of those that tile the bottom against `x`: the first, the
/// middle and the last station and the one of index `marked` by name, all others thin and grey.
std::vector<Series> station_series(const trace::BottomTrace& trace, const std::vector<double>& x,
                                   const std::vector<double>& values, std::size_t marked) {
  constexpr int grey = 7;
  const std::vector<std::size_t> annuli = annuli_of(trace);
  std::vector<Series> background, named;
  for (const std::size_t annulus : annuli) {
    const trace::Station& station = trace.stations[annulus];
    Series series{.x = x, .style = Style::line, .colour = grey};
    for (std::size_t sample = 0; sample < x.size(); ++sample)
      series.y.push_back(values[sample * trace.stations.size() + annulus]);
    const bool is_named = annulus == annuli.front() || annulus == annuli.back() ||
                          annulus == annuli[annuli.size() / 2] || annulus == marked;
    if (!is_named) {
      background.push_back(std::move(series));
      continue;
    }
    series.label = station_name(station);
    series.colour = static_cast<int>(named.size());
    named.push_back(std::move(series));
  }
  if (!background.empty()) background.front().label = "stations between";
  background.insert(background.end(), named.begin(), named.end());
  return background;
}

/// The gaps of a case that hold what a kind of pictures needs.
std::vector<const run::GapResult*> gaps_with(bool (*what)(const DrawnCase&, const run::GapResult&),
                                             const DrawnCase& drawn) {
  std::vector<const run::GapResult*> gaps;
  for (const run::GapResult& gap : drawn.result.gaps)
    if (what(drawn, gap)) gaps.push_back(&gap);
  return gaps;
}

/// A quantity of one gap against time.
Plot gap_plot(const DrawnCase& drawn, const run::GapResult& gap, const std::string& quantity) {
  Plot plot = time_plot(drawn, "", quantity);
  if (const auto& ignition = gap.skin.ignition)
    plot.vertical_lines = {
        {shown_value(ignition->time, drawn_time().form),
         fmt::format("ignition at {}, {}", trace_of(drawn).stations[ignition->station].name,
                     in_words(ignition->time, quantity::ignition_time.form))}};
  return plot;
}

/// "histories_0.04cm.svg".
Picture picture_of_gap(const char* name, const run::GapResult& gap, Plot plot) {
  return {fmt::format("{}_{}.svg", name, gap_in_name(gap.gap)), std::move(plot), {}, {}, gap.gap};
}

// --- profiles ---

const Column distance_from_axis{"r", "distance from the axis, r", keys::significant(4, millimetre),
                                "Distance from the axis."};

/// The bottom of every gap at one instant, or as it is last without ignition.
Plot profile_plot(const DrawnCase& drawn, std::optional<double> time) {
  const trace::BottomTrace& trace = trace_of(drawn);
  Plot plot = titled_plot(drawn, {});
  plot.x = {.label = distance_from_axis.label(), .minimum = 0.0};
  plot.y.label = quantity::skin_temperature.label();
  double spread = 0.0;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    const std::size_t samples = samples_before_ignition(skin);
    if (samples == 0) continue;
    const double last = skin.time[samples - 1], instant = time.value_or(last);
    Series& series = plot.series.emplace_back(Series{.label = "gap " + centimetres(gap->gap)});
    if (skin.ignition && instant >= last) series.label += " at ignition";
    const auto place_of = [&](std::size_t annulus) {
      return shown_value(trace.stations[annulus].r, distance_from_axis.form);
    };
    for (const std::size_t annulus : annuli_of(trace))
      series.add(place_of(annulus),
                 surface::temperature_at_time(skin, trace, annulus, std::min(instant, last)));
    const auto [lowest, highest] = std::ranges::minmax_element(series.y);
    spread = std::max(spread, *highest - *lowest);
  }
  plot.title = time ? "At " + in_words(*time, quantity::time_in_titles) : "In the end";
  plot.title += fmt::format(" the skin differs by {}{} K from axis to wall",
                            plot.series.size() > 1 ? "up to " : "", significant(spread, 2));
  return plot;
}

// --- combustion ---

bool has_combustion(const DrawnCase&, const run::GapResult& gap) {
  return gap.combustion && gap.combustion->samples() > 1;
}

void add_combustion(const DrawnCase& drawn, const run::GapResult& gap, std::vector<Picture>& pictures) {
  const run::CombustionHistory& history = *gap.combustion;
  const auto add = [&](const char* name, std::string title, const std::string& axis,
                       std::vector<Series> series) {
    Plot plot = gap_plot(drawn, gap, axis);
    plot.title = std::move(title);
    plot.series = std::move(series);
    pictures.push_back(picture_of_gap(name, gap, std::move(plot)));
  };
  const Column burnt = headed("burnt mass", quantity::burnt_mass);
  add("combustion_mass",
      fmt::format("Gap {}: {} burn within {} of ignition", centimetres(gap.gap),
                  in_words(history.burnt_mass.back(), keys::significant(2, gram)),
                  in_words(history.time.back() - history.time.front(), keys::significant(2, millisecond))),
      burnt.label(), {time_series("", history.time, history.burnt_mass, burnt)});
  add("combustion_pressure",
      fmt::format("Gap {}: the bottom's mean pressure reaches {} after ignition", centimetres(gap.gap),
                  in_words(std::ranges::max(history.pressure), keys::significant(2, megapascal))),
      headed("mean pressure of the charge's bottom", quantity::pressure).label(),
      {time_series("", history.time, history.pressure, quantity::pressure)});
}

std::string history_title(const DrawnCase& drawn, const run::GapResult& gap) {
  const auto& stations = trace_of(drawn).stations;
  if (const auto& ignition = gap.skin.ignition)
    return fmt::format("Gap {}: {} ignites at {}", centimetres(gap.gap), stations[ignition->station].name,
                       in_words(ignition->time, quantity::ignition_time.form));
  const surface::Maximum& hottest = gap.at_stations;
  const double margin = drawn.scene.charge().kinetics.ignition_temperature - hottest.temperature;
  return fmt::format("Gap {}: {} reaches {}, {} K {} ignition", centimetres(gap.gap),
                     stations[hottest.station].name, in_words(hottest.temperature, keys::fixed(1, kelvin)),
                     fixed(std::abs(margin), 1), margin < 0 ? "above" : "below");
}

std::string lacks_skins(const DrawnCase& drawn) {
  return gaps_with(has_skin, drawn).empty() ? "it holds no skin temperatures of any gap" : "";
}

std::vector<Picture> history_pictures(const DrawnCase& drawn) {
  std::vector<Picture> pictures;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    // What burns is far hotter than all before: it would set the axis.
    std::vector<double> times = shown_values(skin.time, drawn_time());
    times.resize(samples_before_ignition(skin));
    Plot skins = time_plot(drawn, "", quantity::skin_temperature.label());
    skins.series = station_series(trace_of(drawn), times, skin.temperature, gap->at_stations.station);
    const double ignition = drawn.scene.charge().kinetics.ignition_temperature;
    skins.horizontal_lines = {{ignition, "ignites at " + in_words(ignition, keys::significant(4, kelvin))}};
    Plot plot = titled_plot(drawn, history_title(drawn, *gap));
    plot.panels = {std::move(skins), load_plot(drawn)};
    for (Plot& panel : plot.panels) {
      panel.subtitle.clear();
      panel.x.minimum = shown_value(skin.time.front(), drawn_time().form);
      panel.x.maximum = shown_value(skin.time.back(), drawn_time().form);
    }
    plot.panels[1].height = 300;
    pictures.push_back(picture_of_gap("histories", *gap, std::move(plot)));
  }
  return pictures;
}

std::vector<ReportTable> history_tables(const DrawnCase& drawn) {
  const std::vector<trace::Station>& stations = trace_of(drawn).stations;
  std::vector<ReportTable> tables;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    Quantities<std::size_t> quantities{{drawn_time(), at_sample(skin.time)}};
    for (std::size_t i = 0; i < stations.size(); ++i)
      quantities.emplace_back(
          named(stations[i].name, headed(stations[i].name, always(quantity::skin_temperature))),
          [&skin, i, count = stations.size()](std::size_t sample) {
            return skin.temperature[sample * count + i];
          });
    tables.push_back(
        {sample_table(quantities, skin.time.size()), fmt::format("histories_{}.csv", gap_in_name(gap->gap))});
  }
  return tables;
}

std::vector<Picture> profile_pictures(const DrawnCase& drawn) {
  if (drawn.times.empty()) return {{"profile.svg", profile_plot(drawn, {})}};
  std::vector<Picture> pictures;
  for (const double time : drawn.times)
    pictures.push_back({fmt::format("profile_{}ms.svg", digits_of(time, keys::significant(6, millisecond))),
                        profile_plot(drawn, time)});
  return pictures;
}

}  // namespace

bool has_skin(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.skin.time.size() > 1 && !annuli_of(trace_of(drawn)).empty() &&
         gap.skin.temperature.size() == gap.skin.time.size() * trace_of(drawn).stations.size();
}

std::string gap_in_name(double gap) {
  const Form form = quantity::gap.form;
  return digits_of(gap, form) + form.unit;
}

std::vector<std::size_t> annuli_of(const trace::BottomTrace& trace) {
  std::vector<std::size_t> annuli;
  for (std::size_t i = 0; i < trace.stations.size(); ++i)
    if (!trace.stations[i].observation) annuli.push_back(i);
  std::ranges::stable_sort(annuli, {}, [&](std::size_t annulus) { return trace.stations[annulus].r; });
  return annuli;
}

const PictureKind histories_kind{"histories", "skin temperature of the stations against time, for each gap",
                                 lacks_skins, history_pictures, history_tables};
const PictureKind profile_kind{"profile",
                               "skin temperature along the bottom, of all gaps, at the end or at given times",
                               lacks_skins, profile_pictures};
const PictureKind combustion_kind{"combustion", "burnt mass and pressure after ignition",
                                  [](const DrawnCase& drawn) -> std::string {
                                    return gaps_with(has_combustion, drawn).empty()
                                               ? "no gap of it ignited in a run with two-way coupling"
                                               : "";
                                  },
                                  [](const DrawnCase& drawn) {
                                    std::vector<Picture> pictures;
                                    for (const run::GapResult* gap : gaps_with(has_combustion, drawn))
                                      add_combustion(drawn, *gap, pictures);
                                    return pictures;
                                  }};

}  // namespace launchsafe::report::detail
