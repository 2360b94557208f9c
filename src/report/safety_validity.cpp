// How far the computations can be trusted, what was left out, and how to repeat all of it.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/scene/plan.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace launchsafe::report::safety {
namespace {

Table run_table_of(const StudyEvidence& study) {
  return table_of(
      pointers_to(study.rows("runs")),
      {quantity::case_name(), Column{"status", "status"}, quantity::energy_drift(), quantity::steps(),
       quantity::particles(), Column{"limiters", "limiters"}, Column{"stored_case", "stored case"}});
}

void say_stability(const StudyEvidence* stability, SafetySection& section) {
  if (stability == nullptr || !stability->finished()) return section.say("validity.no_stability");
  const Row counts = stability->study.value("counts", Row::object());
  const auto count = [&](const char* key) { return counts.value(key, 0); };
  section.say("validity.stability",
              {{"scene", stability->scene.scene.title},
               {"cases", count("cases")},
               {"held", count("held")},
               {"degraded", count("degraded")},
               {"caught", count("caught")},
               {"wrong", count("WRONG")},
               {"not_computed", count("not_computed")},
               {"sound", count("WRONG") == 0 && count("not_computed") == 0}},
              origin_of(*stability, "counts"));
}

/// The terms of the plan that were left out, and why.
Table left_out_table(const scene::Scene& scene) {
  const scene::Plan plan = scene::make_plan(scene);
  Table table{.columns = {Column{"term", "term"}, Column{"why", "why"}}};
  const std::pair<const char*, const scene::Term*> terms[] = {{"conduction", &plan.conduction},
                                                              {"bulk_reaction", &plan.bulk_reaction},
                                                              {"air", &plan.air},
                                                              {"cracks", &plan.cracks},
                                                              {"crack_growth", &plan.crack_growth},
                                                              {"crack_friction", &plan.crack_friction},
                                                              {"surface", &plan.surface},
                                                              {"friction_heat", &plan.friction_heat},
                                                              {"inertial_scaling", &plan.inertial_scaling},
                                                              {"snapshots", &plan.snapshots}};
  for (const auto& [name, term] : terms)
    if (!term->in) table.rows.push_back({name, term->reason});
  return table;
}

/// Whether the main study took the record that a comparison or an accuracy study wrote: by its digest, or by
/// a bound that its cases took from one.
std::string record_text(const StudyEvidence& main, const StudyEvidence& study) {
  bool used = setting_taken_by(main, study) != nullptr;
  for (const store::WrittenFile& file : study.record.files)
    if (file.name == "model_form.json")
      used = used || main.record.manifest.input_text.find(file.sha256) != std::string::npos;
  const bool has_record = study.kind == "comparison" || study.kind == "accuracy";
  return !has_record || !study.finished() ? "" : used ? "yes" : "no";
}

Table study_table(const SafetyEvidence& evidence) {
  Table table{.columns = {Column{"label", "study"}, Column{"kind", "kind"}, Column{"study", "file"},
                          for_programs(Column{"command", "command"}), Column{"state", "state"},
                          Column{"made", "made"}, for_people(Column{"commit_begins", "commit"}),
                          for_programs(Column{"commit", "commit"}),
                          for_programs(Column{"compiler", "compiler"}),
                          for_programs(Column{"compiler_flags", "compiler flags"}),
                          for_people(Column{"input_begins", "SHA-256 of the input"}),
                          for_programs(Column{"input_sha256", "input SHA-256"}),
                          Column{"record_used", "its record is that of the main study"},
                          Column{"differences", "differs in"}}};
  constexpr std::size_t shown_digits = 12;
  for (const StudyEvidence& study : evidence.studies) {
    const store::Manifest& manifest = study.record.manifest;
    const std::string differs = study.kind == "stability"
                                    ? "scenes of its own"
                                    : fmt::format("{}", fmt::join(study.differences, ", "));
    table.rows.push_back({study.label, study.kind, study.record.study, study.command(),
                          std::string(study.finished() ? "finished" : "unfinished"), manifest.start_time,
                          manifest.commit.substr(0, shown_digits), manifest.commit, manifest.compiler,
                          manifest.compiler_flags, manifest.input_sha256.substr(0, shown_digits),
                          manifest.input_sha256, record_text(evidence.main(), study), differs});
  }
  return table;
}

}  // namespace

SafetySection validity_section(const Subject& subject) {
  SafetySection section{"validity"};
  Table runs = run_table_of(subject.study);
  if (!runs.rows.empty()) section.show("runs", std::move(runs), subject.origin("runs"));
  std::size_t warned = 0;
  for (const Row& row : subject.study.rows("verdicts"))
    if (text_of(row, "reason").find("validity") != std::string::npos) ++warned;
  section.say("validity.warnings", {{"rows", warned}}, subject.origin("verdicts"));
  say_stability(subject.evidence.find("stability"), section);
  section.say("validity.left_out", {}, subject.origin("the scene, in its manifest"));
  section.show("left_out", left_out_table(subject.scene()), subject.origin("the scene, in its manifest"));
  section.say("validity.studies");
  section.show("studies", study_table(subject.evidence));
  section.say("validity.repeat", {{"version", subject.study.record.manifest.model_version},
                                  {"program", subject.study.record.manifest.program_version}});
  for (const StudyEvidence& study : subject.evidence.studies)
    section.say("validity.command", {{"command", study.command()}}, {}, Look::code);
  return section;
}

}  // namespace launchsafe::report::safety
