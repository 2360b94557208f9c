// What followed the ignition of a gap, as tables.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::report {

/// What a run that burnt came to.
struct BurntState {
  double burnt_mass = 0;        ///< g, at its end
  double released = 0;          ///< kJ, of the heat of reaction
  double highest_pressure = 0;  ///< MPa, of the means over the charge's bottom
};
BurntState burnt_state_of(const run::CombustionHistory& combustion);

/// A row a gap that burnt in a run with two-way coupling: flame speeds, end state, balance of energy, cost.
/// No rows where none did.
Table combustion_table(const run::CaseResult& result);

/// At most `rows` samples of one of them, from ignition to the end.
Table combustion_history_table(const run::CombustionHistory& combustion, double gap, std::size_t rows);

}  // namespace launchsafe::report
