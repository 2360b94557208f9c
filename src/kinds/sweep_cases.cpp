// A study of kind sweep: its axes as read from a file, the cases that follow, and its run.
#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/study/answer_cases.hpp"
#include "launchsafe/study/cited_limits.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "study_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;

namespace {

using scene::KeyDescription, scene::Place;

/// The axis that stands for the gaps, which share a mechanical run.
constexpr std::string_view gap_axis = "gap";

Fault read_gap_axis(const toml::node& node, StudyFile& study) {
  const std::string key = "axes." + std::string(gap_axis);
  KeyDescription description = *scene::find_key(scene::scene_keys(), "gap.thickness");
  description.name = key;
  const auto value = scene::read_value(node, description, study.file);
  if (!value) return value.error();
  study.study.gaps = std::get<std::vector<double>>(*value);
  return check_twice(study, key, description.dimension, study.study.gaps);
}

Fault read_axis(const Leaf& leaf, StudyFile& study) {
  const Place place = scene::place_of(*leaf.node, study.file);
  const std::string key = "axes." + leaf.name;
  study.places[key] = place;
  if (leaf.name == gap_axis) return read_gap_axis(*leaf.node, study);
  if (leaf.name == "gap.thickness") {
    return fault_at(study, key, "gap.thickness as an axis", "gap, which all gaps of one mechanical run share",
                    std::string(gap_axis));
  }
  const auto description = varied_key(study, leaf.name, key, place, {std::string(gap_axis)});
  if (!description) return description.error();
  if (Fault fault = check_free(study, description->name, "in [axes]", place, key)) return fault;
  Axis axis{leaf.name, key, *description, {}};
  KeyDescription as_written = *description;
  as_written.name = key;
  const auto values = scene::read_values(*leaf.node, as_written, study.file);
  if (!values) return values.error();
  for (const scene::Value& value : *values) axis.values.push_back(std::get<double>(value));
  if (Fault fault = check_twice(study, key, axis.key.dimension, axis.values)) return fault;
  study.study.axes.push_back(std::move(axis));
  return std::nullopt;
}

Fault read_axes(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("axes");
  if (!node) return std::nullopt;
  const toml::table* table = node->as_table();
  if (!table) {
    return scene::error_at(scene::place_of(*node, study.file), "axes", scene::found_text(*node),
                           "a table, written [axes], of what varies");
  }
  for (const Leaf& leaf : leaves_as_written(*table)) {
    if (Fault fault = read_axis(leaf, study)) return fault;
  }
  return std::nullopt;
}

/// Axes take a list of what their scene key takes one of.
scene::DocumentedKey axis_of(const std::string& name, const std::string& scene_key, std::string sentence) {
  KeyDescription key = *scene::find_key(scene::scene_keys(), scene_key);
  key.name = "axes." + name;
  key.kind = scene::KeyKind::list;
  key.sentence = std::move(sentence);
  return {std::move(key), {}};
}

StudyTable axes_table() {
  StudyTable table{"axes", {}};
  table.keys.push_back(axis_of(std::string(gap_axis), "gap.thickness",
                               "Gaps to judge, all on each mechanical run; those of the scene if absent. "
                               "Beside it write other keys of [gap] in quotation marks: "
                               "\"gap.exchange_time\"."));
  for (const NamedAxis& axis : named_axes()) {
    table.keys.push_back(axis_of(axis.name, axis.key,
                                 fmt::format("Values of {}, each a mechanical run; so may any scene key that "
                                             "takes one number be varied, by its own name.",
                                             axis.key)));
  }
  return table;
}

Fault read_sweep(const StudySource& source, StudyFile& study) {
  if (Fault fault = read_references(source, study)) return fault;
  if (Fault fault = read_cited_limits(source.root, study)) return fault;
  return read_axes(source.root, study);
}

Fault make_sweep_cases(const StudySource&, StudyFile& study) {
  return make_factorial(study, [&study](const StudyCase& made) { return axes_label(study.study, made); });
}

}  // namespace

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), is_indeterminate<CaseAnswer>);
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  return run_answering<SweepResult>(study, options, [](SweepResult&) {});
}

Kind sweep_kind() {
  return {
      .traits = {.name = "sweep", .gaps_key = "axes.gap", .keeps_answers = true},
      .keys = joined({reference_keys(), judging_keys(), calibration_record_keys(), uncertainty_keys()}),
      .tables = {reference_table(), cited_limit_table(), axes_table()},
      .instead_of = {{"gaps", "gap in [axes]"},
                     {"gap", "gap in [axes]"},
                     {"peak_pressures", "peak_pressure in [axes]"},
                     {"crack_radii", "crack_radius in [axes]"},
                     {"flaw_sizes", "flaw_size in [axes]"}},
      .read = read_sweep,
      .make_cases = make_sweep_cases,
      .run = outcome_of<run_sweep, failures_of<SweepResult>>,
      .files = {{"verdicts.csv"},
                {"critical_gaps.json"},
                {"critical_gaps.csv"},
                {"critical_gaps.md"},
                {"critical_gap", ".svg"},
                {"safe_gap", ".svg"}},
      .results = sweep_results,
  };
}

}  // namespace launchsafe::kinds
