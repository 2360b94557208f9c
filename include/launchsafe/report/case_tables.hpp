// What single cases came to, as tables: their runs, how bodies slid, what followed ignition, and the energy
// of the air; and decomposition kinetics in words.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/run/case_result.hpp"

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

/// A row for every face of the charge on which a body can slide: friction work, the largest heat by friction
/// and where, the longest way slid, the widest opening, and how much of the bond holds. Without rows where
/// all bodies are bonded for good.
Table interface_table(const run::MechanicsResult& mechanics);

/// What a run that burnt came to.
Quantities<run::CombustionHistory> burnt_state_quantities();

/// A row a gap that burnt in a run with two-way coupling: flame speeds, end state, balance of energy, cost.
/// No rows where none did.
Table combustion_table(const scene::Scene& scene, const run::CaseResult& result);

/// A row a gap that closed in its launch: when and how the faces met, its air, and where its heat came from
/// and went. No rows where none did.
Table closing_table(const run::CaseResult& result);

/// At most `rows` samples of one of them, from ignition to the end.
Table combustion_history_table(const run::CombustionHistory& combustion, double gap, std::size_t rows);

/// What the columns of the energy of the air are.
std::vector<Column> air_energy_columns();

/// The air of one gap of one case.
struct AuditedGap {
  std::string label;  ///< of the case; empty where there is only one
  double gap = 0;     ///< m
  surface::AirEnergy air;
};

/// What the audit says of temperatures and critical gaps, as a short paragraph: at the gap where the skin
/// took most against its supply, whether that is more than compression can supply, and what follows. Of a
/// film, which has no skin of one temperature, nothing is compared. `closing`: gaps that close stand beside
/// it.
std::string air_energy_statement(scene::AirModel model, const std::vector<AuditedGap>& gaps,
                                 bool closing = false);

/// A row for every gap: taken by the skin, supplied by compression, their ratio; under it the statement.
/// Without rows where there is no gap.
Table air_energy_table(scene::AirModel model, const std::vector<AuditedGap>& gaps, bool closing = false);

/// "runs away by itself in 341 ms from 519 K and in 29.3 ms from 550 K": adiabatic, specific heat in J/(kg
/// K). 519 K is where the air of a gap takes the skin of the 155 mm shell, 550 K what cook-off tests go to.
std::string runaway_text(const materials::KineticsParameters& kinetics, double specific_heat);

/// A sentence: which decomposition the flame of a coupled run lives on, and which decides ignition.
std::string flame_kinetics_note(const scene::Scene& scene);

}  // namespace launchsafe::report
