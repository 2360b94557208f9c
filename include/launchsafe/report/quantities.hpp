// The quantities that several tables hold: each is described here and nowhere else.
#pragma once

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"

#include <string>

namespace launchsafe::report {

/// A length in cm as people read it, six digits.
inline std::string centimetres(double length) { return in_words(length, keys::significant(6, centimetre)); }
/// An instant in ms, likewise.
inline std::string milliseconds(double time) { return in_words(time, keys::significant(6, millisecond)); }

}  // namespace launchsafe::report

namespace launchsafe::report::quantity {

using keys::fixed, keys::scientific, keys::significant, keys::text;

// Of a case.
inline Column case_name() { return {"case", "case", text(), "The case, by what tells it from the others."}; }
inline Column variant() { return {"variant", "variant", text(), "The variant of the study."}; }
inline Column peak_pressure() {
  return {"peak_pressure", "p max", significant(6, megapascal), "Peak pressure of the load."};
}
inline Column crack_radius() {
  return {"crack_radius", "c(0)", significant(6, micrometre), "Initial radius of the charge's cracks."};
}
inline Column flaw_size() {
  return {"flaw_size", "a", significant(6, millimetre), "Size of the charge's initial flaws."};
}
inline Column cell_size() {
  return {"cell_size", "cell", significant(6, millimetre), "Size of the cells that were asked for."};
}
inline Column gap() {
  return always({"gap", "gap", significant(6, centimetre), "Gap between the charge and the base."});
}
inline Column station() {
  return {"station", "station", text(), "Station of the charge's bottom, S1 at the wall."};
}

// Of temperatures. Early: at Study::early_time, s.
inline Column temperature_max() {
  return always({"temperature_max", "T max", fixed(1, kelvin),
                 "Highest temperature of the hottest station; after ignition that of the burning skin."});
}
inline Column temperature_max_place() {
  return {"temperature_max_place", "at", text(), "Station of the highest temperature."};
}
inline Column temperature_max_time() {
  return always(
      {"temperature_max_time", "time", fixed(2, millisecond), "Instant of the highest temperature."});
}
inline Column temperature_max_inert() {
  return {
      "temperature_max_inert", "T max without reaction", fixed(1, kelvin),
      "Highest temperature of a skin that air and friction heat and that neither reacts nor is triggered."};
}
inline Column temperature_early(double early_time) {
  return always({"temperature_early", "T at " + milliseconds(early_time), fixed(1, kelvin),
                 "Temperature of the station that is hottest at the study's early_time, then."});
}
inline Column temperature_early_place() {
  return {"temperature_early_place", "at", text(), "Station that is hottest at the study's early_time."};
}

// Of verdicts.
inline Column uncertainty() {
  return {
      "uncertainty", "uncertainty", significant(2, kelvin),
      "By how much T max may be higher, all shares together; infinite where an end of the range ignites."};
}
inline Column verdict() {
  return {"verdict", "verdict", text(), "SAFE, UNSAFE or INDETERMINATE; only SAFE promises anything."};
}
inline Column reason() { return {"reason", "reason", text(), "Why it is so."}; }
inline Column reason_code() {
  return {"reason_code", "code", text(), "The rule by which the verdict was found."};
}
inline Column remark() { return headed("remark", reason()); }
inline Column ignition_time() {
  return {"ignition_time", "ignition", fixed(2, millisecond), "Instant of ignition."};
}
inline Column skin_took() {
  return {
      "skin_took", "skin took", significant(3, kilojoule_per_area),
      "Heat that the exchange with the air brought to the skin of the hottest station, net and at its most."};
}
inline Column compression_supplies() {
  return {"compression_supplies", "compression supplies", significant(3, kilojoule_per_area),
          "Upper bound of the heat that compressed air can give up."};
}
inline Column taken_over_supplied() {
  return {"taken_over_supplied", "taken over supplied", significant(3),
          "Above 1 the skin took more than compression can supply: energy is not conserved."};
}

// Of published results.
inline Column used_for() {
  return {"used_for", "used for", text(), "Whether the published number was fitted, chosen by, or held out."};
}

// Of critical gaps.
inline Column critical_gap() {
  return {
      "critical_gap", "critical gap", significant(6, centimetre),
      "Smallest gap that ignites, the middle of its bracket; none where the search gave a bound or nothing."};
}
inline Column critical_gap_kind() {
  return {"critical_gap_kind", "kind", text(), "Whether the search gave a value, a bound, or nothing."};
}
inline Column critical_gap_reads_as() {
  return {"critical_gap_reads_as", "critical gap", text(), "The critical gap or its bound in words."};
}

/// By which a report finds the setting of an accuracy study that a case was computed with.
inline Column recorded_uncertainty() {
  return for_programs(
      Column{"recorded_uncertainty", "recorded uncertainty", significant(3, kelvin),
             "Bound of T max that an accuracy record has for the numerics and the launch of the "
             "case; none where no record speaks of it."});
}

// Of runs.
inline Column status() { return {"status", "run", text(), "How the mechanical run ended."}; }
inline Column energy_drift() {
  return {"energy_drift", "energy drift", scientific(1),
          "Largest energy that appeared or vanished over the run, as a share of the largest energy."};
}
inline Column steps() { return {"steps", "steps", count(), "Time steps of the run."}; }
inline Column particles() { return {"particles", "particles", count(), "Particles of the run."}; }
inline Column updates_per_second() {
  return {"updates", "updates", scientific(2, per_second), "Particle updates per second of the run."};
}
inline Column limiters() {
  return {"limiters", "limiters (particle steps)", text(), "How often bounds within the laws acted."};
}
inline Column processor_time() {
  return {"processor_time", "processor time", significant(3, second), "Processor time of the run."};
}
inline Column memory() {
  return {"memory", "memory", fixed(1, megabyte), "Memory that the run takes, as planned."};
}
inline Column wall_time() { return {"wall_time", "wall time", fixed(1, second), "Wall time of the run."}; }

inline Column time(int decimals) {
  return always({"time", "time", fixed(decimals, millisecond), "Time since the load began."});
}

/// An instant within a title.
inline Form time_in_titles() { return significant(4, millisecond); }
inline Column pressure() { return {"pressure", "pressure", significant(6, megapascal), "Pressure."}; }
inline Column skin_temperature() {
  return {"skin_temperature", "skin temperature", fixed(1, kelvin), "Temperature of the charge's skin."};
}

// Of what follows ignition.
inline Column skin_burnt_time() {
  return {"skin_burnt_time", "skin burnt", fixed(3, millisecond), "Instant at which the skin had burnt."};
}
inline Column burnt_mass() {
  return {"burnt_mass", "burnt", significant(3, gram), "Mass of charge that has burnt."};
}
inline Column gas_volume() {
  return {"gas_volume", "gas", significant(3, cubic_centimetre), "Volume of the gas."};
}
inline Column gas_temperature() {
  return {"gas_temperature", "T gas", fixed(0, kelvin), "Temperature of the gas."};
}
inline Column heat_released() {
  return {"heat_released", "released", significant(3, kilojoule), "Heat of reaction that was released."};
}
inline Column bottom_pressure_max() {
  return {"bottom_pressure_max", "p max", significant(3, megapascal),
          "Largest mean pressure of the charge's bottom over the run."};
}
inline Column combustion_residual() {
  return {"combustion_energy_residual", "energy residual", scientific(1),
          "Heat that burning made or lost, as a share of the heat of what burnt."};
}

// Of calibrated constants.
inline Column closure() { return {"closure", "closure", text(), "Friction closure."}; }
inline Column kinetics() { return {"kinetics", "kinetics", text(), "Set of kinetics."}; }
inline Column localisation() {
  return {"localisation", "localisation", significant(6), "Localisation of the heat of friction."};
}
inline Column exchange_time() {
  return {"exchange_time", "exchange time", significant(6, millisecond),
          "Exchange time between air and skin."};
}
inline Column ignition_temperature() {
  return {"ignition_temperature", "T1", fixed(2, kelvin), "Ignition temperature."};
}
inline Column selection_rms() {
  return {"selection_rms", "RMS of selection", fixed(2, kelvin),
          "Root mean square of the differences by which a model is chosen among others."};
}

inline Column load_peak_time() {
  return {"peak_time", "peak time", significant(6, millisecond), "Instant of the load's peak."};
}
inline Column load_width() {
  return {"width", "width", significant(6, millisecond), "Width of the load's bell."};
}
inline Column load_steepness() {
  return {"steepness", "steepness", significant(6), "Steepness of the load's bell."};
}
inline Column change_to_finer() {
  return {"station_change_to_finer", "change to the finer mesh", significant(3, kelvin),
          "Largest change of a station's temperature at the end of the launch, without a gap, to the finer "
          "mesh."};
}
inline Column change_from_coarser() {
  return {"station_change_from_coarser", "from the coarser", significant(3, kelvin),
          "The same from the coarser mesh."};
}

// Of what tables say in units of the row.
inline Column output() { return {"output", "output", text(), "The output that the row is about."}; }
inline Column subject() { return {"quantity", "quantity", text(), "What the row is about."}; }
inline Column unit() { return {"unit", "unit", text(), "Unit of the row's numbers."}; }
inline Column distribution() {
  return {"distribution", "distribution", text(), "Distribution of the input."};
}

}  // namespace launchsafe::report::quantity

namespace launchsafe::report {

/// A gap in the unit in which gaps are shown.
inline double shown_gap(double gap) { return shown_value(gap, quantity::gap().form); }

}  // namespace launchsafe::report
