// The quantities that several tables hold: one name, key and unit each, wherever they stand.
#pragma once

#include "launchsafe/report/columns.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace launchsafe::report::quantity {

// Of a case.
inline Column case_name() { return named_text("case", "case"); }
inline Column peak_pressure() { return significant_column("p max", "MPa", 6, "peak_pressure_MPa"); }
inline Column crack_radius() { return significant_column("c(0)", "um", 6, "crack_radius_um"); }
inline Column flaw_size() { return significant_column("a", "mm", 6, "flaw_size_mm"); }
inline Column cell_size() { return significant_column("cell", "mm", 6, "cell_size_mm"); }
inline Column gap() { return significant_column("gap", "cm", 6, "gap_cm"); }

// Of temperatures. Early: at Study::early_time, s.
inline Column temperature_max() { return number_column("T max", "K", 1, "temperature_max_K"); }
inline Column temperature_max_place() { return named_text("at", "temperature_max_place"); }
inline Column temperature_max_time() { return number_column("time", "ms", 2, "temperature_max_time_ms"); }
/// Of a skin that air and friction heat and that neither reacts nor is triggered.
inline Column temperature_max_inert() {
  return number_column("T max without reaction", "K", 1, "temperature_max_inert_K");
}
/// "10 ms".
inline std::string early_text(double early_time) { return fmt::format("{:.6g} ms", 1e3 * early_time); }
inline Column temperature_early(double early_time) {
  return number_column("T at " + early_text(early_time), "K", 1, "temperature_early_K");
}
inline Column temperature_early_place() { return named_text("at", "temperature_early_place"); }

// Of verdicts.
inline Column uncertainty() { return significant_column("uncertainty", "K", 2, "uncertainty_K"); }
inline Column verdict() { return named_text("verdict", "verdict"); }
inline Column reason() { return named_text("reason", "reason"); }
inline Column ignition_time() { return number_column("ignition", "ms", 2, "ignition_time_ms"); }
inline Column skin_took() { return significant_column("skin took", "kJ/m2", 3, "skin_took_kJ_per_m2"); }
inline Column compression_supplies() {
  return significant_column("compression supplies", "kJ/m2", 3, "compression_supplies_kJ_per_m2");
}
inline Column taken_over_supplied() {
  return significant_column("taken over supplied", "", 3, "taken_over_supplied");
}

// Of published results.
inline Column used_for() { return named_text("used for", "used_for"); }
inline Column computed_minus_published(std::string key) {
  return number_column("computed - published", "K", 1, std::move(key));
}

// Of critical gaps.
inline Column critical_gap() { return significant_column("critical gap", "cm", 6, "critical_gap_cm"); }
inline Column critical_gap_kind() { return named_text("kind", "critical_gap_kind"); }
inline Column critical_gap_reads_as() { return named_text("reads as", "critical_gap_reads_as"); }

// Of runs.
inline Column status(std::string name = "run") { return named_text(std::move(name), "status"); }
inline Column energy_drift() { return scientific_column("energy drift", "", 1, "energy_drift"); }
inline Column steps() { return count_column("steps", "steps"); }
inline Column particles() { return count_column("particles", "particles"); }
inline Column limiters() { return named_text("limiters (particle steps)", "limiters"); }

// Of what follows ignition.
inline Column skin_burnt_time() { return number_column("skin burnt", "ms", 3, "skin_burnt_time_ms"); }
inline Column burnt_mass() { return significant_column("burnt", "g", 3, "burnt_mass_g"); }
inline Column gas_volume() { return significant_column("gas", "cm3", 3, "gas_volume_cm3"); }
inline Column gas_temperature() { return number_column("T gas", "K", 0, "gas_temperature_K"); }
inline Column heat_released() { return significant_column("released", "kJ", 3, "heat_released_kJ"); }
inline Column bottom_pressure_max() {
  return significant_column("p max", "MPa", 3, "bottom_pressure_max_MPa");
}
inline Column combustion_residual() {
  return scientific_column("energy residual", "", 1, "combustion_energy_residual");
}

// Of calibrated constants.
inline Column closure() { return named_text("closure", "closure"); }
inline Column kinetics() { return named_text("kinetics", "kinetics"); }
inline Column localisation() { return significant_column("localisation", "", 6, "localisation"); }
inline Column exchange_time() { return significant_column("exchange time", "ms", 6, "exchange_time_ms"); }
inline Column ignition_temperature() { return number_column("T1", "K", 2, "ignition_temperature_K"); }
inline Column selection_rms() { return number_column("RMS of selection", "K", 2, "selection_rms_K"); }

}  // namespace launchsafe::report::quantity
