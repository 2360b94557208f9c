// What followed the ignition of a gap, as tables.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::report {

/// A row a gap that burnt in a run with two-way coupling: flame speeds, end state, balance of energy, cost.
/// No rows where none did.
Table combustion_table(const run::CaseResult& result);

/// At most `rows` samples of one of them, from ignition to the end.
Table combustion_history_table(const run::CombustionHistory& combustion, double gap, std::size_t rows);

}  // namespace launchsafe::report
