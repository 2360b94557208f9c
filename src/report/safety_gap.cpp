// T max against gap, and the safe envelope over what a sweep varies.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/study/fit.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace launchsafe::report::safety {
namespace {

constexpr double band_level = 0.95;

/// Points, in the legend only where there are any.
void add_points(Series series, Plot& plot) {
  if (!series.x.empty()) plot.series.push_back(std::move(series));
}

void add_computed(const JudgedCase& each, Plot& plot) {
  Series safe{.label = "computed, with uncertainty",
              .style = Style::vertical_bars,
              .colour = 6,
              .mark = Mark::circle};
  Series unknown{.label = "computed, nothing says how wrong",
                 .style = Style::points,
                 .colour = 6,
                 .mark = Mark::open_circle};
  Series ignited{
      .label = "ignites: T max without reaction", .style = Style::points, .colour = 1, .mark = Mark::cross};
  for (const Row* row : each.verdicts) {
    const double gap = number_of(*row, "gap_cm");
    const double temperature = number_of(*row, "temperature_max_K"), u = number_of(*row, "uncertainty_K");
    if (!text_of(*row, "ignition_cause").empty())
      ignited.add(gap, number_of(*row, "temperature_max_inert_K"));
    else if (has_validity_warning(*row))
      unknown.add(gap, temperature);
    else
      safe.add(gap, temperature, std::isfinite(u) ? temperature - u : temperature,
               temperature + (std::isfinite(u) ? u : number_of(*row, "margin_K")));
  }
  for (Series* series : {&safe, &unknown, &ignited}) add_points(std::move(*series), plot);
}

void add_fit(const JudgedCase& each, Plot& plot) {
  const InertRows rows = inert_rows(each);
  const auto fit = math::fit_line(rows.gaps, rows.temperatures);
  if (!fit) return;
  double end = 0;
  for (const Row* row : each.verdicts) end = std::max(end, number_of(*row, "gap_cm"));
  Series line{.label = "straight line through them", .style = Style::line, .colour = 7};
  Series above{.label = "its 95 % band, all gaps at once", .style = Style::dashed_line, .colour = 7};
  Series below{.style = Style::dashed_line, .colour = 7};
  constexpr int parts = 40;
  for (int i = 0; i <= parts; ++i) {
    const double gap = end * i / parts;
    const std::vector<double> at = math::polynomial_row(gap, 1);
    const double middle = fit->at(at);
    line.add(gap, middle);
    if (fit->degrees_of_freedom <= 0) continue;
    const double half = fit->simultaneous_half_width(at, band_level);
    above.add(gap, middle + half);
    below.add(gap, middle - half);
  }
  for (Series* series : {&line, &above, &below}) add_points(std::move(*series), plot);
}

void add_published(const Subject& subject, const JudgedCase& each, Plot& plot) {
  if (&each != subject.own_case()) return;
  struct Use {
    const char *word, *label;
    Mark mark;
    int colour;
  };
  for (const Use& use : {Use{"fitted", "published, fitted to", Mark::open_square, 0},
                         Use{"chosen by", "published, model chosen by", Mark::open_triangle, 2},
                         Use{"held out", "published, held out", Mark::open_circle, 1}}) {
    Series series{.label = use.label, .style = Style::points, .colour = use.colour, .mark = use.mark};
    for (const Row& row : subject.study.rows("comparison"))
      if (text_of(row, "used_for") == use.word &&
          std::isfinite(number_of(row, "temperature_max_computed_minus_published_K")))
        series.add(number_of(row, "gap_cm"), number_of(row, "temperature_max_published_K"));
    add_points(std::move(series), plot);
  }
}

Plot temperature_plot(const Subject& subject, const JudgedCase& each) {
  Plot plot;
  plot.title = "Highest temperature of the charge's bottom against gap";
  plot.subtitle = each.label;
  plot.x.label = "gap [cm]";
  plot.y.label = "T max [K]";
  plot.width = 860;
  add_computed(each, plot);
  add_fit(each, plot);
  add_published(subject, each, plot);
  if (const auto gap = measured_gap(*each.critical)) {
    plot.vertical_lines = {{std::max(0.0, gap->lower()), "critical gap, " + gap->text("cm")},
                           {gap->upper(), ""}};
  }
  const double ignition = subject.scene().charge().kinetics.ignition_temperature;
  plot.horizontal_lines = {{ignition, fmt::format("ignition temperature, {} K", fixed(ignition, 1))}};
  return plot;
}

// --- the sweep ---

struct SweepAxis {
  std::string name, key, unit;
};
std::vector<SweepAxis> axes_of(const StudyEvidence& sweep) {
  std::vector<SweepAxis> axes;
  for (const Row& row : sweep.rows("axes"))
    if (text_of(row, "key") != "gap_cm" && row.contains("values") && row["values"].size() > 1)
      axes.push_back({text_of(row, "name"), text_of(row, "key"), text_of(row, "unit")});
  return axes;
}

std::string words_of(const SweepAxis& axis) {
  std::string name = axis.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string with_unit(const SweepAxis& axis) {
  return axis.unit.empty() ? words_of(axis) : fmt::format("{} [{}]", words_of(axis), axis.unit);
}

/// cm: up to where no ignition is to be expected even at the end of the uncertainty; 0 where no gap is safe.
double envelope_of(const Row& row) {
  if (text_of(row, "critical_gap_kind") == "all-ignite") return 0.0;
  return is_value(row) ? number_of(row, "critical_gap_at_least_cm") : std::nan("");
}

/// At most so many values of the second axis have a line of their own, the first and the last among them.
constexpr std::size_t most_lines = 4;

std::vector<double> shown_values(const StudyEvidence& sweep, const SweepAxis& axis) {
  std::set<double> values;
  for (const Row& row : sweep.rows("cases")) values.insert(number_of(row, axis.key));
  const std::vector<double> all(values.begin(), values.end());
  if (all.size() <= most_lines) return all;
  std::vector<double> shown;
  for (std::size_t i = 0; i < most_lines; ++i) shown.push_back(all[i * (all.size() - 1) / (most_lines - 1)]);
  return shown;
}

/// The critical gaps of a sweep against its first axis, and what its uncertainty leaves of them.
struct SweepLine {
  Series critical, envelope;
};

/// At one value of the second axis, if there is one; the number of the line gives it its look.
SweepLine line_of(const StudyEvidence& sweep, const std::vector<SweepAxis>& axes, std::optional<double> value,
                  int number) {
  const std::string end = value ? fmt::format(", {} {}", significant(*value, 4), axes[1].unit) : "";
  SweepLine line{{.label = "critical gap" + end, .style = Style::vertical_bars, .colour = 0},
                 {.label = "its lower bound" + end,
                  .style = number == 0 ? Style::line : Style::line_and_points,
                  .colour = number}};
  for (const Row& row : sweep.rows("cases")) {
    if (value && number_of(row, axes[1].key) != *value) continue;
    const double x = number_of(row, axes[0].key);
    line.envelope.add(x, envelope_of(row));
    if (!is_value(row)) continue;
    const double gap = number_of(row, "critical_gap_cm");
    const auto bound = [&](const char* key) {
      const double known = number_of(row, key);
      return std::isfinite(known) ? known : gap;
    };
    line.critical.add(x, gap, bound("critical_gap_at_least_cm"), bound("critical_gap_at_most_cm"));
  }
  return line;
}

// --- more than two axes ---

/// "flaw size 1 mm, initial temperature 300 K": where a row lies on the axes from one of them on.
std::string place_on(const std::vector<SweepAxis>& axes, std::size_t first, const Row& row) {
  std::string text;
  for (std::size_t i = first; i < axes.size(); ++i)
    text += fmt::format("{}{} {}{}{}", i > first ? ", " : "", words_of(axes[i]),
                        significant(number_of(row, axes[i].key), 6), axes[i].unit.empty() ? "" : " ",
                        axes[i].unit);
  return text;
}

/// One map of a sweep: the cases of one combination of the axes behind the first two.
struct MappedCases {
  std::string others;  ///< "flaw size 1 mm, initial temperature 300 K"
  std::vector<const Row*> cases;
};

/// In the order in which the sweep draws and numbers its maps: that of its cases.
std::vector<MappedCases> maps_of(const StudyEvidence& sweep, const std::vector<SweepAxis>& axes) {
  std::vector<MappedCases> maps;
  for (const Row& row : sweep.rows("cases")) {
    const std::string others = place_on(axes, 2, row);
    auto map = std::find_if(maps.begin(), maps.end(),
                            [&](const MappedCases& each) { return each.others == others; });
    if (map == maps.end()) map = maps.insert(maps.end(), {others, {}});
    map->cases.push_back(&row);
  }
  return maps;
}

/// What a map shows, for who cannot see it.
Parts parts_of(const MappedCases& map, const std::vector<SweepAxis>& axes) {
  double smallest = std::nan(""), largest_uncertainty = 0;
  std::size_t none = 0, unknown = 0;
  for (const Row* row : map.cases) {
    const double envelope = envelope_of(*row), u = number_of(*row, "critical_gap_cm") - envelope;
    if (!(envelope >= smallest) && std::isfinite(envelope)) smallest = envelope;
    if (is_value(*row) && u > largest_uncertainty) largest_uncertainty = u;
    none += envelope == 0.0;
    unknown += !std::isfinite(envelope) && text_of(*row, "critical_gap_kind") != "all-safe";
  }
  Parts parts{{"others", map.others},
              {"axis", with_unit(axes[0])},
              {"second", with_unit(axes[1])},
              {"cases", map.cases.size()},
              {"none", none},
              {"unknown", unknown}};
  if (std::isfinite(smallest)) parts["smallest"] = part(allowed_text(smallest, 3) + " cm", smallest, "cm");
  if (largest_uncertainty > 0)
    parts["uncertainty"] = part(uncertain_text(largest_uncertainty) + " cm", largest_uncertainty, "cm");
  return parts;
}

/// The maps that the sweep itself drew: the envelope first, then the critical gap that it is taken from.
void say_maps(const StudyEvidence& sweep, const std::vector<SweepAxis>& axes, SafetySection& section) {
  const std::vector<MappedCases> maps = maps_of(sweep, axes);
  std::size_t drawn = 0;
  for (const char* quantity : {"safe_gap", "critical_gap"}) {
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const std::string file = fmt::format("{}{}.svg", quantity, i == 0 ? "" : fmt::format("_{}", i + 1));
      const auto found = sweep.drawings.find(file);
      if (found == sweep.drawings.end()) continue;
      if (std::string_view(quantity) == "safe_gap") ++drawn;
      section.draw(quantity, file, found->second, parts_of(maps[i], axes),
                   origin_of(sweep, "cases", maps[i].others));
    }
  }
  section.say("envelope.maps", {{"count", axes.size()}, {"drawn", drawn}, {"maps", maps.size()}},
              origin_of(sweep, "cases"));
}

void say_envelope(const StudyEvidence& sweep, SafetySection& section) {
  const std::vector<SweepAxis> axes = axes_of(sweep);
  const Origin origin = origin_of(sweep, "cases");
  if (axes.size() > 2) return say_maps(sweep, axes, section);
  if (axes.empty()) return section.say("envelope.axes", {}, origin);
  const std::vector<double> values = axes.size() > 1 ? shown_values(sweep, axes[1]) : std::vector<double>{};
  Plot plot;
  plot.title = "Critical gap, and the safe envelope below it";
  plot.x.label = with_unit(axes[0]);
  plot.y = {.label = "gap [cm]", .minimum = 0.0};
  plot.width = 860;
  // One value with its bars: several on top of each other would hide each other.
  std::vector<Series> envelopes;
  for (std::size_t i = 0; i < std::max<std::size_t>(values.size(), 1); ++i) {
    const auto value = values.empty() ? std::nullopt : std::optional(values[i]);
    SweepLine line = line_of(sweep, axes, value, static_cast<int>(i));
    if (i == 0) plot.series.push_back(std::move(line.critical));
    envelopes.push_back(std::move(line.envelope));
  }
  plot.series.insert(plot.series.end(), envelopes.begin(), envelopes.end());
  section.draw("envelope", "safe_envelope.svg", std::move(plot),
               {{"axis", with_unit(axes[0])},
                {"second", axes.size() > 1 ? with_unit(axes[1]) : ""},
                {"cases", sweep.rows("cases").size()}},
               origin);
  section.say("envelope.read");
}

}  // namespace

std::string name_of_case(const StudyEvidence& study, const Row& row) {
  return study.kind == "sweep" ? place_on(axes_of(study), 0, row) : text_of(row, "case");
}

SafetySection gap_section(const Subject& subject) {
  SafetySection section{"gap"};
  for (const JudgedCase& each : subject.cases) {
    const InertRows inert = inert_rows(each);
    if (inert.gaps.empty()) {
      section.say("gap.nothing_computed", {{"case", each.label}}, subject.origin("verdicts", each.label));
      continue;
    }
    const std::size_t number = static_cast<std::size_t>(&each - subject.cases.data()) + 1;
    section.draw("temperature", number == 1 ? "temperature.svg" : fmt::format("temperature_{}.svg", number),
                 temperature_plot(subject, each),
                 {{"case", each.label},
                  {"rows", inert.gaps.size()},
                  {"line", inert.gaps.size() > 1},
                  {"known", std::none_of(each.verdicts.begin(), each.verdicts.end(),
                                         [](const Row* row) { return has_validity_warning(*row); })},
                  {"band", inert.gaps.size() > 2},
                  {"published", &each == subject.own_case() && !subject.study.rows("comparison").empty()},
                  {"critical", measured_gap(*each.critical).has_value()}},
                 subject.origin("verdicts, fit, comparison", each.label));
  }
  if (!subject.cases.empty() && all_verdicts(subject).size() > most_rows_on_page_one)
    section.show("verdicts", verdict_table(subject), subject.origin("verdicts"));
  if (const StudyEvidence* sweep = subject.evidence.find("sweep"); sweep != nullptr && sweep->finished())
    say_envelope(*sweep, section);
  else
    section.say("envelope.none");
  return section;
}

}  // namespace launchsafe::report::safety
