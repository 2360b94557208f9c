#include "launchsafe/report/verdict_text.hpp"

#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/stations.hpp"
#include "launchsafe/study/uncertainty_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::report {
namespace {

using Json = nlohmann::ordered_json;

std::string ignition_text(const study::GapVerdict& row) {
  if (!row.ignition) return {};
  return fmt::format("{} at {:.2f} ms, {}", study::to_string(row.ignition->cause), 1e3 * row.ignition->time,
                     row.ignition->point);
}

Json json_of(const std::optional<study::NamedIgnition>& ignition) {
  if (!ignition) return nullptr;
  return {{"cause", study::to_string(ignition->cause)},
          {"time_ms", number(1e3 * ignition->time)},
          {"point", ignition->point},
          {"chemical_share", number(ignition->chemical_share)}};
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

}  // namespace

std::vector<Column> verdict_columns(const study::Study& study) {
  return {number_column("T max", "K", 1, "T_max_K"),
          named_text("at", "at"),
          number_column("time", "ms", 2, "time_ms"),
          number_column(fmt::format("T at {:.6g} ms", 1e3 * study.early_time), "K", 1, "T_max_10ms_K"),
          number_column("margin", "K", 2, "margin_K"),
          significant_column("uncertainty", "K", 2, "uncertainty_K"),
          significant_column("of computation", "K", 2, "computation_K"),
          significant_column("of fit", "K", 2, "fit_K"),
          significant_column("of inputs", "K", 2, "inputs_K"),
          significant_column("of model form", "K", 2, "model_form_K"),
          named_text("verdict", "verdict"),
          named_text("reason", "reason"),
          named_text("ignition", "ignition"),
          significant_column("skin took", "kJ/m2", 3, "skin_took_kJ_per_m2"),
          significant_column("compression supplies", "kJ/m2", 3, "compression_supplies_kJ_per_m2"),
          significant_column("taken over supplied", "", 3, "taken_over_supplied")};
}

void add_verdict_cells(const study::GapVerdict& row, std::vector<Cell>& cells) {
  cells.emplace_back(row.maximum.temperature);
  cells.emplace_back(row.maximum.point);
  cells.emplace_back(1e3 * row.maximum.time);
  cells.emplace_back(row.early.temperature);
  cells.emplace_back(row.margin);
  cells.emplace_back(row.uncertainty.total());
  cells.emplace_back(row.uncertainty.computed());
  cells.emplace_back(row.uncertainty.fit);
  cells.emplace_back(row.uncertainty.inputs());
  cells.emplace_back(row.uncertainty.model_form);
  cells.emplace_back(study::to_string(row.judgement.verdict));
  cells.emplace_back(row.judgement.reason);
  cells.emplace_back(ignition_text(row));
  cells.push_back(optional_number(1e-3 * row.air.taken));
  cells.push_back(optional_number(1e-3 * row.air.supplied));
  cells.push_back(optional_number(row.air.ratio()));
}

std::vector<std::string> mesh_notes(const study::StudyFile& study) {
  std::vector<std::string> notes;
  if (study.study.numerical_uncertainty_assumed) {
    notes.push_back(fmt::format("The uncertainty includes up to {} K for mesh, step and scaling, {}.",
                                significant(study.study.numerical_uncertainty, 3), study.uncertainty_source));
  }
  if (std::string note = off_grid_note(study); !note.empty()) notes.push_back(std::move(note));
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

void add_verdict(Json& json, const study::GapVerdict& row) {
  json["T_max_K"] = number(row.maximum.temperature);
  json["at"] = row.maximum.point;
  json["time_ms"] = number(1e3 * row.maximum.time);
  json["T_max_10ms_K"] = number(row.early.temperature);
  json["at_10ms"] = row.early.point;
  json["spread_K"] = number(row.spread);
  json["spread_10ms_K"] = number(row.early_spread);
  json["margin_K"] = number(row.margin);
  json["uncertainty_K"] = number(row.uncertainty.total());
  json["uncertainty_of_computation_K"] = number(row.uncertainty.computed());
  json["uncertainty_of_fit_K"] = number(row.uncertainty.fit);
  json["uncertainty_of_inputs_K"] = number(row.uncertainty.inputs());
  json["uncertainty_of_model_form_K"] = number(row.uncertainty.model_form);
  json["of_these_load_curve_K"] = number(row.uncertainty.load_curve);
  json["of_these_sliding_K"] = number(row.uncertainty.sliding);
  json["verdict"] = study::to_string(row.judgement.verdict);
  json["reason"] = row.judgement.reason;
  json["ignition"] = json_of(row.ignition);
  json["skin_took_kJ_per_m2"] = number(1e-3 * row.air.taken);
  json["compression_supplies_kJ_per_m2"] = number(1e-3 * row.air.supplied);
  json["taken_over_supplied"] = number(row.air.ratio());
}

Json critical_gap_json(const study::CriticalGap& gap) {
  return {{"value_cm", number(100.0 * value_of(gap))}, {"lower_cm", number(100.0 * gap.lower)},
          {"upper_cm", number(100.0 * gap.upper)},     {"uncertainty_cm", number(100.0 * gap.uncertainty)},
          {"kind", study::to_string(gap.kind)},        {"reason", gap.reason}};
}

double value_of(const study::CriticalGap& gap) {
  return gap.kind == study::CriticalGapKind::value ? gap.value : study::not_a_number;
}

std::string reads_as(const study::CriticalGap& gap) {
  switch (gap.kind) {
    case study::CriticalGapKind::value:
      return significant(100.0 * gap.value, 3) + " cm";
    case study::CriticalGapKind::all_safe:
      return "> " + centimetres(gap.lower);
    case study::CriticalGapKind::all_ignite:
      return gap.upper > 0 ? "< " + centimetres(gap.upper) : "ignites without a gap";
    case study::CriticalGapKind::indeterminate:
      break;
  }
  return "indeterminate";
}

std::string friction_remark(const study::StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  std::string text = fmt::format(
      "The friction closure is \"{}\" with a localisation of {}, and the exchange time is {} ms. These two "
      "and "
      "the ignition temperature ({} K) are calibrated on published rows, as are the shape of the load and "
      "the "
      "choice of the model (see `studies/calibrate_table8.toml` and `studies/model_form/README.md`), so the "
      "critical gap of the calibration's own load and defect is a "
      "fit, "
      "not a prediction. What is predicted is how it moves with pressure, defect, load shape and design.\n",
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

std::string uncertainty_remark(const study::StudyFile& study) {
  return fmt::format(
      "The uncertainty of a margin is the root of the sum of squares (ASME V&V 20) of three shares, and on "
      "top "
      "a fourth, of the model form. Of the "
      "computation: the sum of the trace's sampling error, the integration error, where confirmed the "
      "largest "
      "difference between traced and coupled runs, where the charge slides on the base what the "
      "temperatures leave out of that (the heat of friction, and the gap's growth where the base opens), and "
      "{} K for mesh, step and scaling, {}. Of the fit: {} "
      "Of the "
      "inputs: {} Of the model form: {}",
      significant(study.study.numerical_uncertainty, 3), study.uncertainty_source,
      study::fit_uncertainty_text(study.study), study::input_uncertainty_text(study.study),
      study::model_form_uncertainty_text(study));
}

std::string used_for(const study::Reference& paper) {
  return to_string(paper.calibrated || paper.ignited() ? study::Use::calibration : study::Use::held_out);
}

bool acted(const run::LimiterCounts& limiters) {
  return limiters.crack_at_bound + limiters.tension_cutoff + limiters.hugoniot_guard > 0;
}

}  // namespace launchsafe::report
