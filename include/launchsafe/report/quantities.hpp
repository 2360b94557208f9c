// The quantities that several tables hold: each is described here and nowhere else.
#pragma once

#include "launchsafe/report/table.hpp"

namespace launchsafe::report {

/// A length in cm as people read it, six digits.
inline std::string centimetres(double length) { return in_words(length, keys::significant(6, centimetre)); }
/// An instant in ms, likewise.
inline std::string milliseconds(double time) { return in_words(time, keys::significant(6, millisecond)); }

}  // namespace launchsafe::report

namespace launchsafe::report::quantity {

using keys::down, keys::fixed, keys::scientific, keys::significant, keys::text, keys::up;

// Of a case.
inline const Column case_name{"case", "case", text(), "The case, by what tells it from the others."};
inline const Column peak_pressure{"peak_pressure", "p max", significant(6, megapascal),
                                  "Peak pressure of the load."};
inline const Column crack_radius{"crack_radius", "c(0)", significant(6, micrometre),
                                 "Initial radius of the charge's cracks."};
inline const Column flaw_size{"flaw_size", "a", significant(6, millimetre),
                              "Size of the charge's initial flaws."};
inline const Column cell_size{"cell_size", "cell", significant(6, millimetre),
                              "Size of the cells that were asked for."};
inline const Column gap =
    always({"gap", "gap", significant(6, centimetre), "Gap between the charge and the base."});

// Of temperatures. Early: at Study::early_time, s.
inline const Column temperature_max =
    always({"temperature_max", "T max", fixed(1, kelvin),
            "Highest temperature of the hottest station; after ignition that of the burning skin."});
inline const Column temperature_max_place{"temperature_max_place", "at", text(),
                                          "Station of the highest temperature."};
inline const Column temperature_max_time =
    always({"temperature_max_time", "time", fixed(2, millisecond), "Instant of the highest temperature."});
inline const Column temperature_max_inert{
    "temperature_max_inert", "T max without reaction", fixed(1, kelvin),
    "Highest temperature of a skin that air and friction heat and that neither reacts nor is triggered."};
inline Column temperature_early(double early_time) {
  return always({"temperature_early", "T at " + milliseconds(early_time), fixed(1, kelvin),
                 "Temperature of the station that is hottest at the study's early_time, then."});
}

// Of verdicts.
inline const Column margin =
    always({"margin", "margin", down(fixed(2, kelvin)), "Ignition temperature less T max."});
inline const Column uncertainty{
    "uncertainty", "uncertainty", up(significant(2, kelvin)),
    "Uncertainty of T max: the bounds of the critical gap by the slope of T max over the gap."};
inline const Column verdict{"verdict", "verdict", text(),
                            "SAFE, UNSAFE or INDETERMINATE; only SAFE promises anything."};
inline const Column reason{"reason", "reason", text(), "Why it is so."};
inline const Column reason_code{"reason_code", "code", text(), "The rule that gave the verdict."};
inline const Column remark = headed("remark", reason);
inline const Column ignition_time{"ignition_time", "ignition", fixed(2, millisecond), "Instant of ignition."};
inline const Column skin_took{
    "skin_took", "skin took", significant(3, kilojoule_per_area),
    "Heat that the exchange with the air brought to the skin of the hottest station, net and at its most."};
inline const Column compression_supplies{"compression_supplies", "compression supplies",
                                         significant(3, kilojoule_per_area),
                                         "Upper bound of the heat that compressed air can give up."};
inline const Column taken_over_supplied{
    "taken_over_supplied", "taken over supplied", significant(3),
    "Above 1 the skin took more than compression can supply: energy is not conserved."};

// Of published results.
inline const Column used_for{"used_for", "used for", text(),
                             "Whether the constants were fitted to the published number, or it checks them."};

// Of critical gaps.
inline const Column critical_gap{
    "critical_gap", "critical gap", significant(6, centimetre),
    "Smallest gap that ignites, 0 where it ignites without one; none where the search found no ignition."};
inline const Column critical_gap_kind{
    "critical_gap_kind", "kind", text(),
    "value, all-safe, all-ignite, several-crossings (the number is the first), or unknown."};
inline const Column critical_gap_reads_as{"critical_gap_reads_as", "critical gap", text(),
                                          "The critical gap in words."};
inline const Column lower_bound{"critical_gap_at_least", "at least", down(significant(3, centimetre)),
                                "Lower bound of the critical gap: gaps below it are SAFE."};
inline const Column upper_bound{"critical_gap_at_most", "at most", up(significant(3, centimetre)),
                                "Upper bound of the critical gap."};
inline const Column shorter{"shorter", "shorter by", up(significant(2, centimetre)),
                            "By how much the cause may shorten the critical gap."};
inline const Column longer{"longer", "longer by", up(significant(2, centimetre)),
                           "By how much the cause may lengthen the critical gap."};

// Of runs.
inline const Column status{"status", "run", text(), "How the mechanical run ended."};
inline const Column energy_drift{
    "energy_drift", "energy drift", scientific(1),
    "Largest energy that appeared or vanished over the run, as a share of the largest energy."};
inline const Column steps{"steps", "steps", count(), "Time steps of the run."};
inline const Column particles{"particles", "particles", count(), "Particles of the run."};
inline const Column limiters{"limiters", "limiters (particle steps)", text(),
                             "How often bounds within the laws acted."};
inline const Column processor_time{"processor_time", "processor time", significant(3, second),
                                   "Processor time of the run."};
inline const Column wall_time{"wall_time", "wall time", fixed(1, second), "Wall time of the run."};

inline Column time(int decimals) {
  return always({"time", "time", fixed(decimals, millisecond), "Time since the load began."});
}

/// An instant within a title.
inline const Form time_in_titles = significant(4, millisecond);
inline const Column pressure{"pressure", "pressure", significant(6, megapascal), "Pressure."};
inline const Column skin_temperature{"skin_temperature", "skin temperature", fixed(1, kelvin),
                                     "Temperature of the charge's skin."};

// Of what follows ignition.
inline const Column burnt_mass{"burnt_mass", "burnt", significant(3, gram), "Mass of charge that has burnt."};
inline const Column gas_volume{"gas_volume", "gas", significant(3, cubic_centimetre), "Volume of the gas."};
inline const Column gas_temperature{"gas_temperature", "T gas", fixed(0, kelvin), "Temperature of the gas."};
inline const Column heat_released{"heat_released", "released", significant(3, kilojoule),
                                  "Heat of reaction that was released."};
inline const Column bottom_pressure_max{"bottom_pressure_max", "p max", significant(3, megapascal),
                                        "Largest mean pressure of the charge's bottom over the run."};
inline const Column combustion_residual{
    "combustion_energy_residual", "energy residual", scientific(1),
    "Heat that burning made or lost, as a share of the heat of what burnt."};

// Of what tables say in units of the row.
inline const Column output{"output", "output", text(), "The output that the row is about."};
inline const Column subject{"quantity", "quantity", text(), "What the row is about."};
inline const Column unit{"unit", "unit", text(), "Unit of the row's numbers."};
inline const Column distribution{"distribution", "distribution", text(), "Distribution of the input."};

}  // namespace launchsafe::report::quantity

namespace launchsafe::report {

/// A gap in the unit in which gaps are shown.
inline double shown_gap(double gap) { return shown_value(gap, quantity::gap.form); }

}  // namespace launchsafe::report
