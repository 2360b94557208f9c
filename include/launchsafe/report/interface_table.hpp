// How bodies slid on the charge, as a table.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::report {

/// A row for every face of the charge on which a body can slide: friction work, the largest heat by friction
/// and where, the longest way slid, the widest opening, and how much of the bond holds. Without rows where
/// all bodies are bonded for good.
Table interface_table(const run::MechanicsResult& mechanics);

}  // namespace launchsafe::report
