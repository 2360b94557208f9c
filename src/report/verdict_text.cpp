#include "launchsafe/report/verdict_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/stations.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/cited_limits.hpp"
#include "launchsafe/study/study_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

std::string ignition_text(const study::GapVerdict& row) {
  if (!row.ignition) return {};
  return fmt::format("{} at {:.2f} ms, {}", study::to_string(row.ignition->cause), 1e3 * row.ignition->time,
                     row.ignition->point);
}

/// Uncertainties that somebody stated by hand, with their sources; empty without any.
std::string stated_note(const study::Study& study) {
  std::string text;
  for (const study::StatedUncertainty& each : study.stated)
    text += fmt::format("{}{} {} K, because {}", text.empty() ? "Stated by hand: " : "; ", each.key,
                        significant(each.value, 3), each.because);
  return text.empty() ? text : text + ".";
}

/// What nobody accepts, as a file would say it; the first where many cases have values of their own.
std::string acceptance_note(const study::StudyFile& study) {
  constexpr std::size_t most_entries = 12;
  std::vector<scene::Implausible> missing = study::acceptances_of(study).missing;
  const std::size_t count = missing.size();
  missing.resize(std::min(count, most_entries));
  if (missing.empty()) return {};
  return fmt::format(
      "No verdict but UNSAFE rests on what nobody accepts{}. Who takes responsibility writes, with reasons "
      "in "
      "words:\n{}",
      count > most_entries ? fmt::format(" ({} values, the first of which are)", count) : "",
      scene::acceptances_to_write(missing));
}

/// The charge off the grid lines, in the scene of a study or in those of its cases, which may have meshes and
/// bodies of their own.
std::string off_grid_note(const study::StudyFile& study) {
  constexpr const char* meaning = "calibrated constants do not carry over from a grid that fits.";
  if (study.study.axes.empty()) {
    const std::string edges = scene::charge_edges_off_grid(study.scene.scene);
    return edges.empty() ? "" : fmt::format("The charge lies off the grid lines ({}): {}", edges, meaning);
  }
  std::size_t count = 0;
  std::string first;
  for (const study::StudyCase& each : study.cases) {
    const std::string edges = scene::charge_edges_off_grid(each.scene.scene);
    if (edges.empty()) continue;
    if (count++ == 0) first = each.label.empty() ? edges : each.label + ": " + edges;
  }
  if (count == 0) return {};
  return fmt::format("The charge lies off the grid lines in {} of {} cases ({}{}): {}", count,
                     study.cases.size(), count > 1 ? "the first is " : "", first, meaning);
}

/// Of a row of the cited limits.
std::vector<Cell> cells_of_limit(const study::LimitComparison& comparison, const study::StudyFile& study,
                                 const std::vector<const study::CriticalGap*>& critical) {
  std::vector<Cell> cells{100.0 * comparison.limit.gap,
                          optional_number(1e-6 * comparison.limit.peak_pressure), comparison.limit.source};
  if (!comparison.nearest) return cells;
  const study::StudyCase& input = study.cases[*comparison.nearest];
  const study::CriticalGap& gap = *critical[*comparison.nearest];
  cells.insert(cells.end(), {1e-6 * input.peak_pressure, input.label, optional_number(100.0 * value_of(gap)),
                             reads_as(gap), optional_number(100.0 * comparison.difference)});
  return cells;
}

}  // namespace

std::vector<Column> verdict_columns(const study::Study& study) {
  using namespace quantity;
  return {temperature_max(),
          temperature_max_place(),
          temperature_max_time(),
          temperature_early(study.early_time),
          for_programs(temperature_early_place()),
          for_programs(number_column("spread", "K", 1, "spread_K")),
          for_programs(number_column("early spread", "K", 1, "spread_early_K")),
          for_programs(temperature_max_inert()),
          number_column("margin", "K", 2, "margin_K"),
          uncertainty(),
          significant_column("of computation", "K", 2, "uncertainty_of_computation_K"),
          for_programs(significant_column("of sliding", "K", 2, "uncertainty_of_sliding_K")),
          significant_column("of fit", "K", 2, "uncertainty_of_fit_K"),
          significant_column("of inputs", "K", 2, "uncertainty_of_inputs_K"),
          for_programs(significant_column("of load curve", "K", 2, "uncertainty_of_load_curve_K")),
          significant_column("of model form", "K", 2, "uncertainty_of_model_form_K"),
          verdict(),
          reason(),
          for_people(named_text("ignition", "ignition")),
          for_programs(named_text("ignition cause", "ignition_cause")),
          for_programs(ignition_time()),
          for_programs(named_text("ignition at", "ignition_place")),
          for_programs(number_column("chemical share", "", 3, "ignition_chemical_share")),
          skin_took(),
          compression_supplies(),
          taken_over_supplied()};
}

void add_verdict_cells(const study::GapVerdict& row, double inert, std::vector<Cell>& cells) {
  cells.insert(cells.end(), {row.maximum.temperature, row.maximum.point, 1e3 * row.maximum.time,
                             row.early.temperature, row.early.point, optional_number(row.spread),
                             optional_number(row.early_spread), optional_number(inert), row.margin});
  const study::Uncertainty& u = row.uncertainty;
  cells.insert(cells.end(),
               {u.total(), u.computed(), u.sliding, u.fit, u.inputs(), u.load_curve, u.model_form});
  cells.insert(cells.end(),
               {study::to_string(row.judgement.verdict), row.judgement.reason, ignition_text(row)});
  if (row.ignition) {
    cells.insert(cells.end(), {study::to_string(row.ignition->cause), 1e3 * row.ignition->time,
                               row.ignition->point, row.ignition->chemical_share});
  } else {
    cells.resize(cells.size() + 4);
  }
  cells.insert(cells.end(), {optional_number(1e-3 * row.air.taken), optional_number(1e-3 * row.air.supplied),
                             optional_number(row.air.ratio())});
}

std::vector<Column> critical_gap_columns() {
  return {quantity::critical_gap_kind(), quantity::critical_gap(), quantity::critical_gap_reads_as(),
          significant_column("no ignition", "cm", 6, "critical_gap_lower_cm"),
          significant_column("ignites", "cm", 6, "critical_gap_upper_cm")};
}

std::vector<Column> critical_gap_bounds_columns() {
  return {significant_column("at least", "cm", 3, "critical_gap_at_least_cm"),
          significant_column("at most", "cm", 3, "critical_gap_at_most_cm")};
}

void add_critical_gap_cells(const study::CriticalGap& gap, std::vector<Cell>& cells) {
  cells.insert(cells.end(),
               {study::to_string(gap.kind), optional_number(100.0 * value_of(gap)), reads_as(gap),
                optional_number(100.0 * gap.lower), optional_number(100.0 * gap.upper)});
}

void add_critical_gap_bounds_cells(const study::CriticalGap& gap, std::vector<Cell>& cells) {
  cells.insert(cells.end(),
               {optional_number(100.0 * gap.bounds.at_least), optional_number(100.0 * gap.bounds.at_most)});
}

std::vector<std::string> mesh_notes(const study::StudyFile& study) {
  std::vector<std::string> notes;
  if (const auto numerical = study::numerical_uncertainty_of(study); numerical.assumed)
    notes.push_back(fmt::format("The uncertainty includes up to {} K for mesh, step and scaling, {}.",
                                significant(numerical.largest, 3), numerical.source));
  if (std::string note = stated_note(study.study); !note.empty()) notes.push_back(std::move(note));
  if (std::string note = off_grid_note(study); !note.empty()) notes.push_back(std::move(note));
  if (std::string note = acceptance_note(study); !note.empty()) notes.push_back(std::move(note));
  return notes;
}

std::string station_note(const study::StudyFile& study) {
  const scene::Surface& surface = study.scene.scene.surface;
  const std::size_t count = scene::stations_of(study.scene.scene).size();
  return fmt::format(
      "Temperatures are those of the hottest of {} stations that tile the charge's bottom, S1 at the wall, "
      "each {} mm deep; station.width {} mm.",
      count, significant(1e3 * surface.station_depth, 4), significant(1e3 * surface.station_width, 4));
}

double value_of(const study::CriticalGap& gap) {
  return gap.kind == study::CriticalGapKind::value ? gap.value : study::not_a_number;
}

std::string gap_or_bound_text(study::GapOrBound gap) {
  if (std::isnan(gap)) return "not known";
  if (gap == study::no_ignition) return "no ignition";
  return gap > 0.0 ? significant(100.0 * gap, 4) + " cm" : "ignites without a gap";
}

std::string reads_as(const study::CriticalGap& gap) {
  switch (gap.kind) {
    case study::CriticalGapKind::value:
      return significant(100.0 * gap.value, 3) + " cm";
    case study::CriticalGapKind::all_safe:
      return "> " + centimetres(gap.lower);
    case study::CriticalGapKind::all_ignite:
      return gap.upper > 0 ? "< " + centimetres(gap.upper) : "ignites without a gap";
    case study::CriticalGapKind::several_crossings:
      return "several, the first at " + centimetres(gap.lower);
    case study::CriticalGapKind::indeterminate:
      break;
  }
  if (std::isnan(gap.indicative)) return "indeterminate";
  return fmt::format("indeterminate (indicative: {})", gap.indicative == study::no_ignition
                                                           ? "none up to the end of the search"
                                                           : gap_or_bound_text(gap.indicative));
}

Table cited_limit_table(const study::StudyFile& study,
                        const std::vector<const study::CriticalGap*>& critical) {
  Table table;
  if (study.study.cited_limits.empty()) return table;
  table.title = "Cited limits of the gap";
  table.columns = {significant_column("limit", "cm", 6, "limit_cm"),
                   significant_column("at", "MPa", 6, "limit_peak_pressure_MPa"),
                   named_text("source", "source"),
                   significant_column("computed at", "MPa", 6, "peak_pressure_MPa"),
                   quantity::case_name(),
                   quantity::critical_gap(),
                   quantity::critical_gap_reads_as(),
                   significant_column("computed minus cited", "cm", 2, "difference_cm")};
  bool chosen = false;
  for (const study::LimitComparison& each : study::compare_with_limits(study, critical)) {
    chosen = chosen || each.cases > 1;
    table.rows.push_back(cells_of_limit(each, study, critical));
  }
  table.notes.push_back(fmt::format(
      "Beside each limit stands the case with the nearest peak pressure; for one without a pressure, that of "
      "the study's scene. The difference is given where the pressures agree within {:.6g} %.",
      100.0 * study::pressure_slack));
  table.notes.emplace_back(
      "Whether the pressure of a cited limit is that at the breech, at the base or under the charge is not "
      "known.");
  if (chosen)
    table.notes.emplace_back(
        "Of several cases at that pressure it is the one with the smallest critical gap.");
  return table;
}

std::string friction_remark(const study::StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  std::string text = fmt::format(
      "The friction closure is \"{}\" with a localisation of {}, and the exchange time is {} ms. These two "
      "and the ignition temperature ({} K) are calibrated on published rows, as are the shape of the load "
      "and the choice of the model (see `studies/calibrate_table8.toml` and "
      "`studies/model_form/README.md`), so the critical gap of the calibration's own load and defect is a "
      "fit, not a prediction. What it is computed for is how it moves with pressure, defect, load shape and "
      "design. That closed crack faces rub is no part of the published text: without it the charge of the "
      "155 mm shell ignites without a gap from cracks of 30 or 100 um, at a coefficient of 0.02 from those "
      "of 100 um, and from none at 0.05 and above, where defects change T max by some kelvin "
      "(`studies/defects.toml`).\n",
      study::to_string(scene.surface.friction), significant(scene.surface.localisation, 6),
      significant(1e3 * scene.surface.exchange_time, 6),
      significant(scene.charge().kinetics.ignition_temperature, 6));
  std::string varied;
  for (const char* key : {"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"}) {
    if (varies(study.study, key)) varied += fmt::format("{}`{}`", varied.empty() ? "" : ", ", key);
  }
  if (!varied.empty()) text += fmt::format("The study varies {} around these.\n", varied);
  return text;
}

std::optional<Measured> measured_gap(const study::CriticalGap& gap) {
  return measured_gap(100.0 * value_of(gap), 100.0 * gap.bounds.at_least, 100.0 * gap.bounds.at_most);
}

Table gap_share_table(const std::vector<std::pair<std::string, const study::CriticalGap*>>& cases) {
  Table table{
      "What makes the critical gap uncertain",
      {quantity::case_name(), named_text("cause", "cause"), named_text("class", "class"),
       named_text("critical gap towards ignition", "raised"), named_text("at the other end", "lowered"),
       significant_column("lowers the bound by", "cm", 2, "lowers_cm")}};
  for (const auto& [label, gap] : cases) {
    for (const study::GapShare& share : gap->shares) {
      const study::ShareTraits& traits = study::traits_of(share.kind);
      table.rows.push_back({label, traits.title, study::to_string(traits.of_class),
                            gap_or_bound_text(share.raised), gap_or_bound_text(share.lowered),
                            optional_number(100.0 * study::move_towards_ignition(gap->lower, share))});
    }
  }
  if (!table.rows.empty())
    table.notes.push_back(fmt::format(
        "Every cause is put to the ends of its range by itself, and the critical gap is searched anew. "
        "Random "
        "causes, raised by {:g} standard deviations, are combined as the root of the sum of squares; what is "
        "not known better stands at its worst end, and is added. The bounds follow.",
        study::coverage_factor));
  return table;
}

std::string uncertainty_remark(const study::StudyFile& study) {
  const study::NumericalUncertainty numerical = study::numerical_uncertainty_of(study);
  return fmt::format(
      "A verdict is judged in gap: SAFE is a gap below the lower bound of the critical gap. Kelvins are told "
      "besides, and decide where nothing ignites up to the end of the search; one that is infinite says that "
      "the gap ignites at that end of the range. They are the sum of four shares. Of the computation: the "
      "sum "
      "of the trace's sampling error, the "
      "integration error, where confirmed the largest difference between traced temperatures and coupled "
      "runs, where the charge slides on the base what the temperatures leave out of that (the heat of "
      "friction, and the gap's growth where the base opens), and {} K for mesh, step and scaling, {}. Of the "
      "fit: {} Of the inputs: {} Of the model form: {}",
      significant(numerical.largest, 3), numerical.source, study::fit_uncertainty_text(study.study),
      study::input_uncertainty_text(study.study), study::model_form_uncertainty_text(study));
}

std::string used_for(const study::Reference& published) {
  using enum study::Use;
  // That a gap ignites is what the ignition temperature is fitted to.
  if (published.calibrated || published.ignited()) return to_string(fitted);
  return to_string(published.selection ? chosen_by : held_out);
}

bool acted(const run::LimiterCounts& limiters) {
  return limiters.crack_at_bound + limiters.tension_cutoff + limiters.hugoniot_guard > 0;
}

}  // namespace launchsafe::report
