// Skin temperatures along the charge's bottom, the gap's air, and what burns.
#include "case_pictures_parts.hpp"
#include "launchsafe/study/verdict.hpp"

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
  const std::vector<std::size_t> rings = rings_of(trace);
  std::vector<Series> background, named;
  for (const std::size_t ring : rings) {
    const trace::Station& station = trace.stations[ring];
    Series series{.x = x, .style = Style::line, .colour = grey};
    for (std::size_t sample = 0; sample < x.size(); ++sample)
      series.y.push_back(values[sample * trace.stations.size() + ring]);
    const bool is_named =
        ring == rings.front() || ring == rings.back() || ring == rings[rings.size() / 2] || ring == marked;
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

/// The temperatures of a gap as they were published.
std::vector<study::Peak> published_of(const DrawnCase& drawn, const run::GapResult& gap) {
  std::vector<study::Peak> all;
  for (const study::Reference& row : drawn.published) {
    if (!(std::abs(row.gap - gap.gap) <= 1e-9)) continue;
    all.push_back({row.early_temperature, drawn.early_time, row.early_point});
    // That of one that ignited is the burning skin's.
    if (!row.ignited())
      all.push_back({row.maximum_temperature, scene::read_time(drawn.scene.load), row.point});
  }
  std::erase_if(all, [](const study::Peak& each) { return std::isnan(each.temperature); });
  return all;
}

/// The ring of the bottom in which a station or an observation point lies; none of another name.
std::optional<std::size_t> ring_of(const trace::BottomTrace& trace, const std::string& name) {
  const auto point = std::ranges::find(trace.stations, name, &trace::Station::name);
  if (point == trace.stations.end()) return {};
  const std::vector<std::size_t> rings = rings_of(trace);
  return *std::ranges::min_element(
      rings, {}, [&](std::size_t ring) { return std::abs(trace.stations[ring].r - point->r); });
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
Plot gap_plot(const DrawnCase& drawn, const run::GapResult& gap, const char* what,
              const std::string& quantity) {
  Plot plot = time_plot(drawn, what, quantity);
  if (const auto& ignition = gap.skin.ignition)
    plot.vertical_lines = {
        {shown_value(ignition->time, drawn_time().form),
         fmt::format("ignition at {}, {}", trace_of(drawn).stations[ignition->station].name,
                     in_words(ignition->time, quantity::ignition_time.form))}};
  return plot;
}

/// "histories_0.04cm.svg".
CasePicture picture_of_gap(const char* name, const run::GapResult& gap, Plot plot) {
  return {fmt::format("{}_{}.svg", name, gap_in_name(gap.gap)), std::move(plot), {}, gap.gap};
}

// --- profiles ---

const Column distance_from_axis{"r", "distance from the axis, r", keys::significant(4, millimetre),
                                "Distance from the axis."};

/// The bottom of every gap at one instant, or as it is last without ignition; bars go from the curves to what
/// was published.
Plot profile_plot(const DrawnCase& drawn, std::optional<double> time) {
  const trace::BottomTrace& trace = trace_of(drawn);
  Plot plot = titled_plot(drawn, {});
  plot.x = {.label = distance_from_axis.label(), .minimum = 0.0};
  plot.y.label = quantity::skin_temperature.label();
  plot.named_in_place = true;
  Series published{
      .label = "published", .style = Style::vertical_bars, .colour = 6, .mark = Mark::open_square};
  double spread = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    const std::size_t samples = samples_before_ignition(skin);
    if (samples == 0) continue;
    const double last = skin.time[samples - 1], instant = time.value_or(last);
    Series& series = plot.series.emplace_back(Series{.label = "gap " + centimetres(gap->gap)});
    if (skin.ignition && instant >= last) series.label += " at ignition";
    const auto place_of = [&](std::size_t ring) {
      return shown_value(trace.stations[ring].r, distance_from_axis.form);
    };
    for (const std::size_t ring : rings_of(trace))
      series.add(place_of(ring), surface::temperature_at_time(skin, trace, ring, std::min(instant, last)));
    const auto [lowest, highest] = std::ranges::minmax_element(series.y);
    spread = std::max(spread, *highest - *lowest);
    for (const study::Peak& each : published_of(drawn, *gap)) {
      const auto ring = ring_of(trace, each.point);
      if (!ring || std::abs(each.time - instant) >= 1e-6) continue;
      const double computed = surface::temperature_at_time(skin, trace, *ring, each.time);
      const auto [low, high] = std::minmax({computed, each.temperature});
      published.add(place_of(*ring), each.temperature, low, high);
      least = std::min(least, each.temperature - computed);
      most = std::max(most, each.temperature - computed);
      plot.subtitle =
          fmt::format("{}; hottest: published r {}, computed r {} mm", shortened(drawn.scene.title, 50),
                      significant(place_of(*ring), 4),
                      significant(series.x[static_cast<std::size_t>(highest - series.y.begin())], 4));
    }
  }
  const std::string from = fixed(least, 1), to = fixed(most, 1);
  plot.title = time ? "At " + in_words(*time, quantity::time_in_titles) : "In the end";
  plot.title += published.x.empty()
                    ? fmt::format(" the skin differs by {}{} K from axis to wall",
                                  plot.series.size() > 1 ? "up to " : "", significant(spread, 2))
                    : fmt::format(" published minus computed temperatures are {} K",
                                  from == to ? to : from + " to " + to);
  if (!published.x.empty()) plot.series.push_back(std::move(published));
  return plot;
}

// --- air ---

bool has_air(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.gap > 0.0 && has_skin(drawn, gap) && gap.skin.air_temperature.size() == gap.skin.time.size() &&
         samples_before_ignition(gap.skin) > 0;
}

/// Air temperatures until ignition, one line for gaps that have the same.
Plot air_plot(const DrawnCase& drawn) {
  constexpr double same = 0.05;  // K
  Plot plot = time_plot(drawn, {}, headed("air temperature", quantity::skin_temperature).label());
  plot.named_in_place = true;
  double highest = 0.0;
  for (const run::GapResult* gap : gaps_with(has_air, drawn)) {
    Series line = time_series("", gap->skin.time, gap->skin.air_temperature, quantity::skin_temperature);
    line.label = "gap " + centimetres(gap->gap);
    line.x.resize(samples_before_ignition(gap->skin));
    line.y.resize(line.x.size());
    highest = std::max(highest, std::ranges::max(line.y));
    const auto like = std::ranges::find_if(plot.series, [&](const Series& other) {
      return std::ranges::mismatch(line.y, other.y, [](double a, double b) {
               return std::abs(a - b) < same;
             }).in1 == line.y.begin() + static_cast<std::ptrdiff_t>(std::min(line.y.size(), other.y.size()));
    });
    if (like == plot.series.end())
      plot.series.push_back(std::move(line));
    else
      like->label = "every gap";
  }
  if (plot.series.size() > 1)
    for (Series& line : plot.series)
      if (line.label == "every gap") line.label = "others";
  plot.title = fmt::format("The gap's air reaches {}{}", in_words(highest, keys::fixed(0, kelvin)),
                           plot.series.size() == 1 ? ", whatever the gap" : "");
  return plot;
}

// --- combustion ---

bool has_combustion(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.combustion && gap.combustion->samples() > 1 && !rings_of(trace_of(drawn)).empty() &&
         gap.combustion->reaction_degree.size() ==
             gap.combustion->samples() * trace_of(drawn).stations.size();
}

/// How far the skin has burnt in the end.
std::string reaction_title(const DrawnCase& drawn, const run::GapResult& gap) {
  constexpr double burnt_up = 0.99;
  const run::CombustionHistory& history = *gap.combustion;
  const std::vector<std::size_t> rings = rings_of(trace_of(drawn));
  const std::size_t last = history.reaction_degree.size() - trace_of(drawn).stations.size();
  const auto burnt = std::ranges::count_if(
      rings, [&](std::size_t ring) { return history.reaction_degree[last + ring] > burnt_up; });
  return fmt::format("Gap {}: the skin of {} of {} stations has burnt {} after ignition",
                     centimetres(gap.gap), burnt, rings.size(),
                     in_words(history.time.back() - history.time.front(), keys::significant(2, millisecond)));
}

void add_combustion(const DrawnCase& drawn, const run::GapResult& gap, std::vector<CasePicture>& pictures) {
  const run::CombustionHistory& history = *gap.combustion;
  const auto add = [&](const char* name, std::string title, const std::string& axis,
                       std::vector<Series> series, const char* remark = "") {
    Plot plot = gap_plot(drawn, gap, "", axis);
    plot.title = std::move(title);
    plot.subtitle += remark;
    plot.series = std::move(series);
    plot.named_in_place = true;
    pictures.push_back(picture_of_gap(name, gap, std::move(plot)));
  };
  const bool whole = drawn.scene.symmetry == scene::Symmetry::axisymmetric;
  const Column burnt = headed(whole ? "burnt mass" : "burnt mass per metre", quantity::burnt_mass);
  add("combustion_mass",
      fmt::format("Gap {}: {} burn within {} of ignition", centimetres(gap.gap),
                  in_words(history.burnt_mass.back(), keys::significant(2, gram)),
                  in_words(history.time.back() - history.time.front(), keys::significant(2, millisecond))),
      burnt.label(), {time_series("", history.time, history.burnt_mass, burnt)},
      "; a step: the skin of one more station burns");
  add("combustion_pressure",
      fmt::format("Gap {}: the bottom's mean pressure reaches {} after ignition", centimetres(gap.gap),
                  in_words(std::ranges::max(history.pressure), keys::significant(2, megapascal))),
      headed("mean pressure of the charge's bottom", quantity::pressure).label(),
      {time_series("", history.time, history.pressure, quantity::pressure)});
  add("combustion_reaction", reaction_title(drawn, gap), "reaction degree of the skin [1]",
      station_series(trace_of(drawn), shown_values(history.time, drawn_time()), history.reaction_degree,
                     gap.skin.ignition ? gap.skin.ignition->station : trace_of(drawn).stations.size()));
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

std::vector<CasePicture> history_pictures(const DrawnCase& drawn) {
  std::vector<CasePicture> pictures;
  for (const run::GapResult* gap : gaps_with(has_skin, drawn)) {
    const surface::SkinHistory& skin = gap->skin;
    // What burns is far hotter than all before: it would set the axis.
    std::vector<double> times = shown_values(skin.time, drawn_time());
    times.resize(samples_before_ignition(skin));
    Plot skins = time_plot(drawn, "", quantity::skin_temperature.label());
    skins.series = station_series(trace_of(drawn), times, skin.temperature, gap->at_stations.station);
    constexpr std::array<Mark, 2> marks{Mark::open_square, Mark::open_circle};
    const std::vector<study::Peak> peaks = published_of(drawn, *gap);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const auto& [temperature, time, point] = peaks[i];
      Series published{.label = point.empty() ? "published" : "published at " + point,
                       .x = {shown_value(time, drawn_time().form)},
                       .y = {temperature},
                       .style = Style::points,
                       .colour = 6,
                       .mark = marks[i % marks.size()]};
      if (const auto ring = ring_of(trace_of(drawn), point)) {
        const double above = temperature - surface::temperature_at_time(skin, trace_of(drawn), *ring, time);
        published.label += fmt::format(": {} {} {} K", trace_of(drawn).name_of(*ring),
                                       above < 0.0 ? "-" : "+", fixed(std::abs(above), 1));
      }
      skins.series.push_back(std::move(published));
    }
    const double ignition = drawn.scene.charge().kinetics.ignition_temperature;
    skins.horizontal_lines = {{ignition, "ignites at " + in_words(ignition, keys::significant(4, kelvin))}};
    Plot plot = titled_plot(drawn, history_title(drawn, *gap));
    plot.panels = {std::move(skins), load_plot(drawn)};
    for (Plot& panel : plot.panels) {
      panel.subtitle.clear();
      panel.named_in_place = true;
      panel.x.minimum = shown_value(skin.time.front(), drawn_time().form);
      panel.x.maximum = shown_value(skin.time.back(), drawn_time().form);
    }
    plot.panels[1].height = 300;
    plot.columns = 1;
    pictures.push_back(picture_of_gap("histories", *gap, std::move(plot)));
  }
  return pictures;
}

std::vector<CaseTable> history_tables(const DrawnCase& drawn) {
  const std::vector<trace::Station>& stations = trace_of(drawn).stations;
  std::vector<CaseTable> tables;
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
        {fmt::format("histories_{}.csv", gap_in_name(gap->gap)), sample_table(quantities, skin.time.size())});
  }
  return tables;
}

std::vector<CasePicture> profile_pictures(const DrawnCase& drawn) {
  if (drawn.times.empty()) return {{"profile.svg", profile_plot(drawn, {})}};
  std::vector<CasePicture> pictures;
  for (const double time : drawn.times)
    pictures.push_back({fmt::format("profile_{}ms.svg", digits_of(time, keys::significant(6, millisecond))),
                        profile_plot(drawn, time)});
  return pictures;
}

std::string lacks_air(const DrawnCase& drawn) {
  return gaps_with(has_air, drawn).empty() ? "it holds no gap with air" : "";
}

std::vector<CasePicture> air_pictures(const DrawnCase& drawn) { return {{"air.svg", air_plot(drawn)}}; }

}  // namespace

bool has_skin(const DrawnCase& drawn, const run::GapResult& gap) {
  return gap.skin.time.size() > 1 && !rings_of(trace_of(drawn)).empty() &&
         gap.skin.temperature.size() == gap.skin.time.size() * trace_of(drawn).stations.size();
}

std::string gap_in_name(double gap) {
  const Form form = quantity::gap.form;
  return digits_of(gap, form) + form.unit;
}

std::vector<std::size_t> rings_of(const trace::BottomTrace& trace) {
  std::vector<std::size_t> rings;
  for (std::size_t i = 0; i < trace.stations.size(); ++i)
    if (!trace.stations[i].observation) rings.push_back(i);
  std::ranges::stable_sort(rings, {}, [&](std::size_t ring) { return trace.stations[ring].r; });
  return rings;
}

const PictureKind histories_kind{"histories", "skin temperature of the stations against time, for each gap",
                                 lacks_skins, history_pictures, history_tables};
const PictureKind profile_kind{"profile",
                               "skin temperature along the bottom, of all gaps, at the end or at given times",
                               lacks_skins, profile_pictures};
const PictureKind air_kind{"air", "air temperature against time", lacks_air, air_pictures};
const PictureKind combustion_kind{"combustion", "burnt mass, pressure and reaction degree after ignition",
                                  [](const DrawnCase& drawn) -> std::string {
                                    return gaps_with(has_combustion, drawn).empty()
                                               ? "no gap of it ignited in a run with two-way coupling"
                                               : "";
                                  },
                                  [](const DrawnCase& drawn) {
                                    std::vector<CasePicture> pictures;
                                    for (const run::GapResult* gap : gaps_with(has_combustion, drawn))
                                      add_combustion(drawn, *gap, pictures);
                                    return pictures;
                                  }};

}  // namespace launchsafe::report::detail
