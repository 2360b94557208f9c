// Where everything is in a case file, but for the snapshots. Each function serves writing and reading, as
// those of snapshot_layout.hpp do.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "snapshot_layout.hpp"

namespace launchsafe::store {

/// The file format's own words, in the order of each enumeration; they stay when the program's messages
/// change.
inline constexpr std::array<std::string_view, 9> run_status_words{
    "completed",   "non_finite", "energy_drift",    "time_step_collapse", "particles_left_grid",
    "interrupted", "timed_out",  "cells_distorted", "outside_gas_law"};
inline constexpr std::array<std::string_view, 2> ignition_cause_words{"trigger", "arrhenius"};
static_assert(run_status_words.size() == static_cast<std::size_t>(run::last_status) + 1);

template <class Archive, class Value>
void lay_out_manifest(Archive& archive, Value& manifest) {
  archive.group("manifest", "Where this result came from", [&] {
    archive.value("input", manifest.input_text, {"none", "all that determines the case"});
    archive.value("input_sha256", manifest.input_sha256, {"none", "SHA-256 of the input"});
    integer(archive, "model_version", manifest.model_version,
            {"1", "version of the model; others give other numbers"});
    archive.value("program_version", manifest.program_version, {"none", "version of launchsafe"});
    archive.value("commit", manifest.commit, {"none", "commit that the program was built from"});
    archive.value("compiler", manifest.compiler, {"none", "compiler of the program"});
    archive.value("compiler_flags", manifest.compiler_flags, {"none", "flags of the compiler"});
    archive.value("build_type", manifest.build_type, {"none", "CMake build type"});
    archive.value("host", manifest.host, {"none", "machine"});
    integer(archive, "threads", manifest.threads, {"1", "threads that the program used"});
    archive.value("start_time", manifest.start_time, {"none", "start, ISO 8601, UTC"});
    archive.value("wall_time", manifest.wall_time, {"s", "wall time of the case"});
  });
}

template <class Archive, class Trace>
void lay_out_trace(Archive& archive, Trace& trace) {
  using trace::Station;
  archive.group("stations", "Annuli of the charge's bottom, and observation points", [&] {
    column(archive, "name", trace.stations, &Station::name, {"none", "name"});
    column(archive, "x", trace.stations, &Station::x, {"m", "initial axial position"});
    column(archive, "r", trace.stations, &Station::r, {"m", "initial radial position"});
    column(archive, "area", trace.stations, &Station::area, {"m2", "of the annulus"});
    column(archive, "observation", trace.stations, &Station::observation, {"1", "1 for observation points"});
  });
  archive.array("time", trace.time, {"s", "time since the start of the load"});
  const std::size_t samples = trace.time.size();
  archive.array("chamber_pressure", trace.chamber_pressure, {"Pa", "pressure on the base"});
  archive.array("bottom_pressure", trace.bottom_pressure,
                {"Pa", "area mean of the axial compression over the bottom row"});
  archive.array("mean_bottom_pressure", trace.mean_bottom_pressure,
                {"Pa", "bottom pressure, mean over the interval that ends at the sample"});
  archive.table(
      "friction_literal", trace.friction, {samples, trace.stations.size()},
      {"J/m3", "friction energy since the start without localisation; rows are times, columns stations"});
}

template <class Archive, class Rows>
void lay_out_monitor(Archive& archive, Rows& rows) {
  using run::MonitorSample;
  column(archive, "time", rows, &MonitorSample::time, {"s", "time"});
  column(archive, "time_step", rows, &MonitorSample::time_step, {"s", "time step"});
  for (const auto& term : run::energy_terms)
    column(archive, term.name, rows, [&](auto& sample) -> auto& { return sample.energy.*term.member; },
           {term.unit, term.meaning});
  column(archive, "largest_plastic_strain", rows, &MonitorSample::largest_plastic_strain,
         {"1", "largest equivalent plastic strain"});
  column(archive, "largest_crack_radius", rows, &MonitorSample::largest_crack_radius,
         {"m", "largest crack radius"});
  column(archive, "momentum", rows, &MonitorSample::momentum,
         {"kg m/s", "axial momentum relative to the frame"});
}

template <class Archive, class Value>
void lay_out_mechanics(Archive& archive, Value& mechanics) {
  archive.group("mechanics", "The mechanical run", [&] {
    choice(archive, "status", mechanics.status, run_status_words, {"none", "how the run ended"});
    archive.value("reason", mechanics.reason, {"none", "when and where, if not completed"});
    archive.value("end_time", mechanics.end_time, {"s", "time reached"});
    archive.value("steps", mechanics.steps, {"1", "time steps"});
    archive.value("particles", mechanics.particles, {"1", "particles"});
    archive.value("wall_time", mechanics.wall_time, {"s", "wall time of the mechanics"});
    if constexpr (!Archive::reading)
      archive.value("update_rate", mechanics.update_rate(), {"1/s", "particle updates per second"});
    archive.group("masses", "Masses by material, summed over the particles", [&] {
      column(archive, "material", mechanics.masses, &run::MaterialMass::material, {"none", "material"});
      column(archive, "mass", mechanics.masses, &run::MaterialMass::mass, {"kg", "mass"});
    });
    archive.group("limiters", "How often limiters acted",
                  [&] { lay_out_members(archive, mechanics.limiters, run::limiters); });
    archive.group("interfaces", "Faces of the charge on which bodies can slide", [&] {
      column(archive, "body", mechanics.interfaces, &run::InterfaceResult::body,
             {"none", "the body that touches the charge"});
      column(archive, "overlap", mechanics.interfaces, &run::InterfaceResult::overlap,
             {"m", "largest by which the faces passed into each other"});
    });
    archive.value("yielded_wall", mechanics.yielded_wall,
                  {"m", "axial length of the wall whose plastic strain exceeds 0.2 %"});
    archive.group("monitor", "History of the energy balance and of stability",
                  [&] { lay_out_monitor(archive, mechanics.monitor); });
    archive.group("trace", "History of the charge bottom", [&] { lay_out_trace(archive, mechanics.trace); });
  });
  list(archive, "snapshots", "Particle fields at one time", mechanics.snapshots,
       [&](auto& snapshot) { lay_out_snapshot(archive, snapshot); });
}

/// Station names beside their numbers are for people; reading goes by the number.
template <class Archive>
void lay_out_station(Archive& archive, auto& station, const trace::BottomTrace& trace) {
  archive.value("station", station, {"1", "index of the station"});
  if constexpr (!Archive::reading)
    archive.value("station_name", trace.name_of(station), {"none", "name of the station"});
}

template <class Archive>
void lay_out_ignition(Archive& archive, auto& ignition, const trace::BottomTrace& trace) {
  optional_group(
      archive, "ignition", "First ignition; absent when there is none", ignition, [&](auto& first) {
        archive.value("time", first.time, {"s", "time of ignition"});
        lay_out_station(archive, first.station, trace);
        choice(archive, "cause", first.cause, ignition_cause_words,
               {"none", "trigger: T1 by heating from outside"});
        archive.value("chemical_share", first.chemical_share, {"1", "Arrhenius share of the heating at T1"});
      });
}

template <class Archive>
void lay_out_combustion(Archive& archive, auto& combustion, const trace::BottomTrace& trace) {
  optional_group(archive, "combustion", "What followed ignition; absent without two-way coupling", combustion,
                 [&](auto& c) {
                   lay_out_members(archive, c, run::stored_combustion);
                   archive.table("reaction_degree", c.reaction_degree, {c.samples(), trace.stations.size()},
                                 {"1", "of the skin; rows are times, columns stations"});
                   if (is_there(archive, "snapshots", !c.snapshots.empty()))
                     list(archive, "snapshots", "Particle fields at one time", c.snapshots,
                          [&](auto& snapshot) { lay_out_snapshot(archive, snapshot); });
                 });
}

template <class Archive>
void lay_out_maximum(Archive& archive, const std::string& name, const std::string& description, auto& maximum,
                     const trace::BottomTrace& trace) {
  archive.group(name, description, [&] {
    archive.value("temperature", maximum.temperature, {"K", "highest temperature"});
    archive.value("time", maximum.time, {"s", "when"});
    lay_out_station(archive, maximum.station, trace);
  });
}

template <class Archive>
void lay_out_air_energy(Archive& archive, auto& air) {
  archive.group("air_energy", "Energies per area of the bottom, until the end or ignition", [&] {
    archive.value("taken", air.taken,
                  {"J/m2", "most that the skin of the hottest station took from the air"});
    archive.value("supplied", air.supplied, {"J/m2", "most that compression can supply to the air"});
  });
}

template <class Archive, class Value>
void lay_out_gap(Archive& archive, Value& gap, const trace::BottomTrace& trace) {
  auto& skin = gap.skin;
  archive.value("gap", gap.gap, {"m", "thickness of the bottom gap"});
  lay_out_maximum(archive, "maximum_at_stations", "T_max over the stations, which tile the bottom",
                  gap.at_stations, trace);
  lay_out_maximum(archive, "maximum_at_points", "T_max over the observation points", gap.at_points, trace);
  lay_out_ignition(archive, skin.ignition, trace);
  lay_out_combustion(archive, gap.combustion, trace);
  lay_out_air_energy(archive, gap.air);
  archive.group("skin", "Skin temperatures", [&] {
    archive.value("gap", skin.gap, {"m", "gap of this history"});
    archive.array("time", skin.time, {"s", "time"});
    archive.array("air_temperature", skin.air_temperature, {"K", "temperature of the gap's air"});
    archive.table("temperature", skin.temperature, {skin.time.size(), trace.stations.size()},
                  {"K", "skin temperature; rows are times, columns stations"});
  });
}

template <class Archive, class Value>
void lay_out_result(Archive& archive, Value& result) {
  lay_out_mechanics(archive, result.mechanics);
  list(archive, "gaps", "One bottom gap", result.gaps,
       [&](auto& gap) { lay_out_gap(archive, gap, result.mechanics.trace); });
}

}  // namespace launchsafe::store
