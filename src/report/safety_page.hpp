// The page of a safety report before it is written: facts, tables and figures.
#pragma once

#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::report {

/// What the template says is filled with the facts; tables and figures stand where it names them.
struct SafetyPage {
  Row facts = Row::object();
  std::map<std::string, Table> tables = {};
  std::map<std::string, std::vector<Picture>> figures = {};
};

SafetyPage safety_page(const SafetyEvidence& evidence);

}  // namespace launchsafe::report
