// What the skin took from the air of a gap against what compression can supply, as a table and in words.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/scene/scene.hpp"
#include "launchsafe/surface/air_energy.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// The air of one gap of one case.
struct AuditedGap {
  std::string label;  ///< of the case; empty where there is only one
  double gap = 0;     ///< m
  surface::AirEnergy air;
};

/// What the audit says of temperatures and critical gaps, as a short paragraph: at the gap where the skin
/// took most against its supply, whether that is more than compression can supply, and what follows. Of a
/// film, which has no skin of one temperature, nothing is compared.
std::string air_energy_statement(scene::AirModel model, const std::vector<AuditedGap>& gaps);

/// A row for every gap: taken by the skin, supplied by compression, their ratio; under it the statement.
/// Without rows where there is no gap.
Table air_energy_table(scene::AirModel model, const std::vector<AuditedGap>& gaps);

}  // namespace launchsafe::report
