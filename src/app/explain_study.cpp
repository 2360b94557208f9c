#include "explain_study.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/scene/plan.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>

namespace launchsafe::app {
namespace {

/// Coupled runs on the two sides of a bracket.
constexpr std::size_t confirmations_per_case = 2;

double updates_of(const scene::Plan& plan) {
  return static_cast<double>(plan.particles()) * static_cast<double>(plan.steps);
}

report::Table case_table(const study::StudyFile& file, double update_rate) {
  report::Table table;
  table.columns = {report::text_column("mechanical run"),
                   {.name = "particles", .unit = ""},
                   {.name = "steps", .unit = ""},
                   {.name = "memory", .unit = "MB"},
                   {.name = "time", .unit = "s"}};
  for (const study::StudyCase& each : file.cases) {
    const scene::Plan plan = scene::make_plan(each.scene.scene);
    table.rows.push_back({each.label, plan.particles(), plan.steps, plan.memory / 1e6,
                          scene::predicted_time(plan, update_rate)});
  }
  return table;
}

std::string line(std::string_view label, const std::string& value) {
  return fmt::format("  {:<22}{}\n", label, value);
}

}  // namespace

StudyCost cost_of(const study::StudyFile& file, double update_rate, int jobs) {
  StudyCost cost;
  cost.runs = file.cases.size();
  const bool bisects = file.study.kind == study::StudyKind::critical_gap;
  if (bisects && file.study.confirm) cost.confirmations = confirmations_per_case * cost.runs;
  cost.gaps = bisects ? file.study.gaps.size() : 0;
  cost.jobs = std::max(1, std::min(jobs, static_cast<int>(std::max(cost.runs, cost.confirmations))));
  double updates = 0, longest = 0;
  for (const study::StudyCase& each : file.cases) {
    const scene::Plan plan = scene::make_plan(each.scene.scene);
    updates += updates_of(plan);
    longest = std::max(longest, updates_of(plan));
    cost.memory = std::max(cost.memory, plan.memory * cost.jobs);
  }
  // Confirmations wait for the bracket; either stage ends no sooner than its longest run.
  const double repeats =
      cost.runs > 0 ? static_cast<double>(cost.confirmations) / static_cast<double>(cost.runs) : 0;
  cost.updates = updates * (1.0 + repeats);
  const double runs = std::max(longest, updates / cost.jobs);
  const double confirmations = repeats > 0 ? std::max(longest, repeats * updates / cost.jobs) : 0;
  cost.time = (runs + confirmations) / update_rate;
  return cost;
}

std::string study_text(const study::StudyFile& file, const StudyCost& cost, double update_rate) {
  std::string text = file.study.title.empty() ? std::string{} : file.study.title + "\n\n";
  text += "Study\n";
  text += line("kind", study::to_string(file.study.kind));
  text += line("scene", file.study.scene);
  for (const auto& [key, value] : file.overrides) text += line("  " + key, value);
  text += line("mechanical runs", fmt::format("{}", cost.runs));
  if (file.study.kind == study::StudyKind::critical_gap) {
    text += line("coupled runs", fmt::format("at most {}, to confirm the critical gap", cost.confirmations));
    text += line("gaps", fmt::format("{} on the trace of each run, then a bisection", cost.gaps));
  }
  text += line("at a time", fmt::format("{}", cost.jobs));
  text += line("memory", fmt::format("about {:.3g} MB", cost.memory / 1e6));
  text += line("time", fmt::format("about {} at {:.3g} particle updates per second on a core",
                                   report::duration(cost.time), update_rate));
  return text + "\n" + report::to_text(case_table(file, update_rate));
}

nlohmann::ordered_json study_json(const study::StudyFile& file, const StudyCost& cost, double update_rate) {
  return {{"title", file.study.title},
          {"kind", study::to_string(file.study.kind)},
          {"mechanical_runs", cost.runs},
          {"coupled_runs_at_most", cost.confirmations},
          {"gaps", cost.gaps},
          {"jobs", cost.jobs},
          {"particle_updates", cost.updates},
          {"updates_per_second", update_rate},
          {"memory_bytes", cost.memory},
          {"predicted_time_s", cost.time},
          {"runs", report::to_json(case_table(file, update_rate))["rows"]}};
}

}  // namespace launchsafe::app
