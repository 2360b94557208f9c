// The description by which ParaView finds the snapshots in a case file.
#pragma once

#include "launchsafe/run/case_result.hpp"

#include <string>
#include <vector>

namespace launchsafe::store {

/// An XDMF document: the particles as quadrilateral cells with values on cells, a time series; as points
/// where the snapshots do not hold the cells. `case_file` is the case file's name without its folder.
std::string xdmf_of(const std::vector<run::Snapshot>& snapshots, const std::string& case_file);

}  // namespace launchsafe::store
