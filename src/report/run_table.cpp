#include "launchsafe/report/run_table.hpp"

#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"

namespace launchsafe::report {

Table run_table(const std::vector<NamedRun>& runs) {
  Table table;
  table.title = "Runs";
  table.columns = {quantity::case_name(),    quantity::status("status"),
                   quantity::energy_drift(), quantity::steps(),
                   quantity::particles(),    scientific_column("updates", "1/s", 2, "updates_per_second"),
                   quantity::limiters(),     for_programs(named_text("stored case", "stored_case"))};
  for (const NamedRun& each : runs) {
    const run::MechanicsResult& run = *each.mechanics;
    table.rows.push_back({each.name, each.failure.empty() ? "completed" : each.failure,
                          optional_number(run::largest_energy_drift(run)),
                          static_cast<std::int64_t>(run.steps), static_cast<std::int64_t>(run.particles),
                          optional_number(run.update_rate()), limiters_text(run.limiters), each.stored});
  }
  return table;
}

}  // namespace launchsafe::report
