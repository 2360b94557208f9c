// The description by which ParaView finds the snapshots in a case file.
#pragma once

#include "launchsafe/run/case_result.hpp"

#include <string>

namespace launchsafe::store {

/// An XDMF document of time series: the particles as quadrilateral cells with values on cells, or as points
/// where the snapshots do not hold the cells; the charge's bottom as a line a station with the skins of all
/// gaps on it; each face that can slide as a chain of lines with values at its nodes; and the same of every
/// gap that burns. `case_file` is the case file's name without its folder.
std::string xdmf_of(const run::CaseResult& result, const std::string& case_file);

}  // namespace launchsafe::store
