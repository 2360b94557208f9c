#include "layout.hpp"

namespace launchsafe::store {
namespace {

using run::MechanicsResult, run::MonitorSample, run::Stored, trace::BottomTrace, trace::Station;

/// The file format's own words, in the order of each enumeration; they stay when the program's messages
/// change.
constexpr std::array<std::string_view, 9> run_status_words{
    "completed",   "non_finite", "energy_drift",    "time_step_collapse", "particles_left_grid",
    "interrupted", "timed_out",  "cells_distorted", "outside_gas_law"};
constexpr std::array<std::string_view, 2> ignition_cause_words{"trigger", "arrhenius"};
constexpr std::array<std::string_view, 3> combustion_end_words{"time", "pressure", "broke_off"};
static_assert(run_status_words.size() == static_cast<std::size_t>(run::last_status) + 1);

constexpr std::tuple mechanics_members{
    Stored{"reason", &MechanicsResult::reason, "none"},
    Stored{"end_time", &MechanicsResult::end_time, "s"},
    Stored{"steps", &MechanicsResult::steps, "1"},
    Stored{"particles", &MechanicsResult::particles, "1"},
    Stored{"wall_time", &MechanicsResult::wall_time, "s"},
    Stored{"yielded_wall", &MechanicsResult::yielded_wall, "m"},
};
constexpr std::tuple mass_members{
    Stored{"material", &run::MaterialMass::material, "none"},
    Stored{"mass", &run::MaterialMass::mass, "kg"},
};
constexpr std::tuple monitor_members{
    Stored{"time", &MonitorSample::time, "s"},
    Stored{"time_step", &MonitorSample::time_step, "s"},
    Stored{"largest_plastic_strain", &MonitorSample::largest_plastic_strain, "1"},
    Stored{"largest_crack_radius", &MonitorSample::largest_crack_radius, "m"},
    Stored{"momentum", &MonitorSample::momentum, "kg m/s"},
};
constexpr std::tuple station_members{
    Stored{"name", &Station::name, "none"},
    Stored{"x", &Station::x, "m"},
    Stored{"r", &Station::r, "m"},
    Stored{"area", &Station::area, "m2"},
    Stored{"observation", &Station::observation, "1"},
};
constexpr std::tuple trace_members{
    Stored{"time", &BottomTrace::time, "s"},
    Stored{"chamber_pressure", &BottomTrace::chamber_pressure, "Pa"},
    Stored{"bottom_pressure", &BottomTrace::bottom_pressure, "Pa"},
    Stored{"mean_bottom_pressure", &BottomTrace::mean_bottom_pressure, "Pa"},
};
constexpr std::tuple gap_members{
    Stored{"gap", &run::GapResult::gap, "m"},
};
constexpr std::tuple maximum_members{
    Stored{"temperature", &surface::Maximum::temperature, "K"},
    Stored{"time", &surface::Maximum::time, "s"},
    Stored{"station", &surface::Maximum::station, "1"},
};
constexpr std::tuple ignition_members{
    Stored{"time", &surface::Ignition::time, "s"},
    Stored{"station", &surface::Ignition::station, "1"},
    Stored{"chemical_share", &surface::Ignition::chemical_share, "1"},
};
constexpr std::tuple air_members{
    Stored{"taken", &surface::AirEnergy::taken, "J/m2"},
    Stored{"supplied", &surface::AirEnergy::supplied, "J/m2"},
};
constexpr std::tuple skin_history_members{
    Stored{"gap", &surface::SkinHistory::gap, "m"},
    Stored{"time", &surface::SkinHistory::time, "s"},
    Stored{"air_temperature", &surface::SkinHistory::air_temperature, "K"},
};

/// Tables have a row for every sample and a column for every station.
void lay_out(Hdf5& file, const std::string& at, BottomTrace& trace) {
  columns(file, at + "stations/", trace.stations, station_members);
  members(file, at, trace, trace_members);
  file.table(at + "friction_literal", trace.friction, trace.time.size(), trace.stations.size(), "J/m3");
}

void lay_out(Hdf5& file, const std::string& at, MechanicsResult& mechanics) {
  choice(file, at + "status", mechanics.status, run_status_words);
  members(file, at, mechanics, mechanics_members);
  columns(file, at + "masses/", mechanics.masses, mass_members);
  members(file, at + "limiters/", mechanics.limiters, run::limiters);
  columns(file, at + "interfaces/", mechanics.interfaces, run::stored_interface);
  columns(file, at + "monitor/", mechanics.monitor, monitor_members);
  for (const auto& term : run::energy_terms)
    column(
        file, at + "monitor/" + term.name, mechanics.monitor,
        [&](MonitorSample& sample) -> double& { return sample.energy.*term.member; }, term.unit);
  lay_out(file, at + "trace/", mechanics.trace);
}

void lay_out_snapshots(Hdf5& file, const std::string& at, std::vector<run::Snapshot>& snapshots) {
  list(file, at, snapshots,
       [&](const std::string& in, run::Snapshot& snapshot) { lay_out(file, in, snapshot); });
}

void lay_out(Hdf5& file, const std::string& at, run::CombustionHistory& combustion, std::size_t stations) {
  choice(file, at + "end", combustion.end, combustion_end_words);
  members(file, at, combustion, run::stored_combustion);
  file.table(at + "reaction_degree", combustion.reaction_degree, combustion.samples(), stations, "1");
  lay_out_snapshots(file, at + "snapshots/", combustion.snapshots);
}

void lay_out(Hdf5& file, const std::string& at, run::GapResult& gap, std::size_t stations) {
  members(file, at, gap, gap_members);
  members(file, at + "maximum_at_stations/", gap.at_stations, maximum_members);
  members(file, at + "maximum_at_points/", gap.at_points, maximum_members);
  optional_part(file, at + "ignition", gap.skin.ignition,
                [&](const std::string& in, surface::Ignition& ignition) {
                  members(file, in, ignition, ignition_members);
                  choice(file, in + "cause", ignition.cause, ignition_cause_words);
                });
  optional_part(
      file, at + "combustion", gap.combustion,
      [&](const std::string& in, run::CombustionHistory& burning) { lay_out(file, in, burning, stations); });
  members(file, at + "air_energy/", gap.air, air_members);
  members(file, at + "skin/", gap.skin, skin_history_members);
  file.table(at + "skin/temperature", gap.skin.temperature, gap.skin.time.size(), stations, "K");
}

}  // namespace

void lay_out(Hdf5& file, run::CaseResult& result) {
  lay_out(file, "mechanics/", result.mechanics);
  lay_out_snapshots(file, "snapshots/", result.mechanics.snapshots);
  list(file, "gaps/", result.gaps, [&](const std::string& at, run::GapResult& gap) {
    lay_out(file, at, gap, result.mechanics.trace.stations.size());
  });
}

}  // namespace launchsafe::store
