// How mechanical runs went, as a table.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// A run with the name of its case.
struct NamedRun {
  std::string name;
  std::string failure;  ///< why it is no basis for results; empty where it is
  const run::MechanicsResult* mechanics = nullptr;
  std::string stored;  ///< the file in the folder of results that holds it; empty: none
};

/// A row for every run: how it ended, energy drift, steps, particles, particle updates per second, limiters.
Table run_table(const std::vector<NamedRun>& runs);

}  // namespace launchsafe::report
