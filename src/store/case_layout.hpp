// Where everything is in a case file, but for the snapshots. Each function serves writing and reading, as
// those of snapshot_layout.hpp do.
#pragma once

#include "launchsafe/store/manifest.hpp"
#include "snapshot_layout.hpp"

#include <array>

namespace launchsafe::store {

/// The file format's own words; they stay when the program's messages change.
inline constexpr std::array run_status_names{
    Named{run::RunStatus::completed, "completed"},
    Named{run::RunStatus::non_finite, "non_finite"},
    Named{run::RunStatus::energy_drift, "energy_drift"},
    Named{run::RunStatus::time_step_collapse, "time_step_collapse"},
    Named{run::RunStatus::particles_left_grid, "particles_left_grid"},
    Named{run::RunStatus::interrupted, "interrupted"},
    Named{run::RunStatus::timed_out, "timed_out"},
    Named{run::RunStatus::cells_distorted, "cells_distorted"},
    Named{run::RunStatus::outside_gas_law, "outside_gas_law"},
    Named{run::RunStatus::flame_beyond_sound, "flame_beyond_sound"},
};
inline constexpr std::array ignition_cause_names{
    Named{surface::IgnitionCause::trigger, "trigger"},
    Named{surface::IgnitionCause::arrhenius, "arrhenius"},
};
inline constexpr std::array combustion_end_names{
    Named{run::CombustionEnd::time, "time"},
    Named{run::CombustionEnd::pressure, "pressure"},
    Named{run::CombustionEnd::broke_off, "broke_off"},
    Named{run::CombustionEnd::burnt_through, "burnt_through"},
};

template <class Archive, class Value>
void lay_out_manifest(Archive& archive, Value& manifest) {
  archive.group("manifest", "Where this result came from", [&] {
    archive.value("input", manifest.input_text, {"none", "all that determines the case"});
    archive.value("input_sha256", manifest.input_sha256, {"none", "SHA-256 of the input"});
    if (is_there(archive, "model_version"))
      integer(archive, "model_version", manifest.model_version,
              {"1", "version of the model; others give other numbers"});
    archive.value("program_version", manifest.program_version, {"none", "version of launchsafe"});
    archive.value("commit", manifest.commit, {"none", "commit that the program was built from"});
    archive.value("compiler", manifest.compiler, {"none", "compiler of the program"});
    archive.value("compiler_flags", manifest.compiler_flags, {"none", "flags of the compiler"});
    archive.value("build_type", manifest.build_type, {"none", "CMake build type"});
    archive.group("libraries", "Libraries that the program was built with", [&] {
      column(archive, "name", manifest.libraries, &LibraryVersion::name, {"none", "name of the library"});
      column(archive, "version", manifest.libraries, &LibraryVersion::version, {"none", "its version"});
    });
    archive.value("host", manifest.host, {"none", "machine"});
    integer(archive, "threads", manifest.threads, {"1", "threads that the program used"});
    archive.value("start_time", manifest.start_time, {"none", "start, ISO 8601, UTC"});
    archive.value("wall_time", manifest.wall_time, {"s", "wall time of the case"});
  });
}

template <class Archive, class Trace>
void lay_out_trace(Archive& archive, Trace& trace) {
  using trace::Station;
  archive.group("stations", "Rings of the charge's bottom, and observation points", [&] {
    column(archive, "name", trace.stations, &Station::name, {"none", "name"});
    column(archive, "x", trace.stations, &Station::x, {"m", "initial axial position"});
    column(archive, "r", trace.stations, &Station::r, {"m", "initial radial position"});
    column(archive, "area", trace.stations, &Station::area, {"m2", "of the ring"});
    column(archive, "observation", trace.stations, &Station::observation, {"1", "1 for observation points"});
  });
  archive.array("time", trace.time, {"s", "time since the start of the load"});
  const std::size_t samples = trace.time.size();
  history(archive, "chamber_pressure", trace.chamber_pressure, samples, {"Pa", "pressure on the base"});
  history(archive, "bottom_pressure", trace.bottom_pressure, samples,
          {"Pa", "area mean of the axial compression over the bottom row"});
  history(archive, "mean_chamber_pressure", trace.mean_chamber_pressure, samples,
          {"Pa", "chamber pressure, mean over the interval that ends at the sample"});
  history(archive, "mean_bottom_pressure", trace.mean_bottom_pressure, samples,
          {"Pa", "bottom pressure, mean over the interval that ends at the sample"});
  history(archive, "steps", trace.steps, samples, {"1", "time steps since the start"});
  for (std::size_t closure = 0; closure < trace::traced_closures; ++closure) {
    archive.table(
        "friction_" + std::string(materials::friction_closures[closure].stored_word), trace.friction[closure],
        {samples, trace.stations.size()},
        {"J/m3", "friction energy since the start without localisation; rows are times, columns stations"});
  }
}

template <class Archive, class Rows>
void lay_out_energy(Archive& archive, Rows& rows) {
  const auto energy = [&](const std::string& name, double run::EnergyBalance::*term,
                          const std::string& what) {
    column(archive, name, rows, [term](auto& sample) -> auto& { return sample.energy.*term; }, {"J", what});
  };
  using run::EnergyBalance;
  energy("kinetic_energy", &EnergyBalance::kinetic,
         "kinetic energy relative to the frame, with the scaled inertia");
  energy("internal_energy", &EnergyBalance::internal, "integrated stress power");
  energy("external_work", &EnergyBalance::external, "work of the chamber pressure");
  energy("body_force_work", &EnergyBalance::body_force, "work of the accelerating frame's body force");
  energy("damping_loss", &EnergyBalance::damping, "taken out by damping and the PIC share");
  if (is_there(archive, "contact_loss"))
    energy("contact_loss", &EnergyBalance::contact,
           "taken out by friction between bodies, where their faces close, and by gas between them");
  energy("plastic_dissipation", &EnergyBalance::plastic, "dissipated in steel");
  energy("viscous_dissipation", &EnergyBalance::viscous, "dissipated in the charge's Maxwell elements");
  energy("crack_dissipation", &EnergyBalance::crack, "dissipated by crack growth");
  energy("hourglass", &EnergyBalance::hourglass, "stored against hourglassing, part of the internal energy");
}

template <class Archive, class Rows>
void lay_out_monitor(Archive& archive, Rows& rows) {
  using run::MonitorSample;
  column(archive, "time", rows, &MonitorSample::time, {"s", "time"});
  column(archive, "time_step", rows, &MonitorSample::time_step, {"s", "time step"});
  lay_out_energy(archive, rows);
  column(archive, "largest_plastic_strain", rows, &MonitorSample::largest_plastic_strain,
         {"1", "largest equivalent plastic strain"});
  column(archive, "largest_crack_radius", rows, &MonitorSample::largest_crack_radius,
         {"m", "largest crack radius"});
  column(archive, "momentum", rows, &MonitorSample::momentum,
         {"kg m/s", "axial momentum relative to the frame"});
}

template <class Archive, class Value>
void lay_out_interface(Archive& archive, Value& faces) {
  archive.value("body", faces.body, {"none", "the body that touches the charge"});
  integer(archive, "along_x", faces.along_x, {"1", "1 for a side of the charge, 0 for an end"});
  archive.value("face", faces.face, {"m", "initial r of a side, x of an end"});
  archive.value("friction_work", faces.friction_work, {"J", "work of friction, turned into heat"});
  archive.array("place", faces.place, {"m", "initial x along a side, r along an end"});
  const std::size_t nodes = faces.place.size();
  history(archive, "friction_heat", faces.friction_heat, nodes, {"J/m2", "heat of friction since the start"});
  history(archive, "slid", faces.slid, nodes, {"m", "way slid since the start, to and fro added up"});
  history(archive, "largest_gap", faces.largest_gap, nodes, {"m", "by which the faces parted"});
  history(archive, "overlap", faces.overlap, nodes, {"m", "by which the faces passed into each other"});
  history(archive, "bonded", faces.bonded, nodes, {"1", "1 where the bond still holds"});
}

template <class Archive, class Value>
void lay_out_mechanics(Archive& archive, Value& mechanics) {
  archive.group("mechanics", "The mechanical run", [&] {
    choice(archive, "status", mechanics.status, run_status_names, {"none", "how the run ended"});
    archive.value("reason", mechanics.reason, {"none", "when and where, if not completed"});
    archive.value("end_time", mechanics.end_time, {"s", "time reached"});
    archive.value("steps", mechanics.steps, {"1", "time steps"});
    if (is_there(archive, "steps_before"))
      archive.value("steps_before", mechanics.steps_before,
                    {"1", "of them, up to the checkpoint from which the run went on"});
    archive.value("particles", mechanics.particles, {"1", "particles"});
    archive.value("wall_time", mechanics.wall_time, {"s", "wall time of the mechanics"});
    if constexpr (!Archive::reading)
      archive.value("update_rate", mechanics.update_rate(), {"1/s", "particle updates per second"});
    archive.group("masses", "Masses by material, summed over the particles", [&] {
      column(archive, "material", mechanics.masses, &run::MaterialMass::material, {"none", "material"});
      column(archive, "mass", mechanics.masses, &run::MaterialMass::mass, {"kg", "mass"});
    });
    archive.group("limiters", "How often limiters acted", [&] {
      auto& limiters = mechanics.limiters;
      archive.value("crack_at_bound", limiters.crack_at_bound,
                    {"1", "particles whose crack reached its bound"});
      archive.value("tension_cutoff", limiters.tension_cutoff,
                    {"1", "particles that reached the tension cut-off"});
      archive.value("hugoniot_guard", limiters.hugoniot_guard,
                    {"1", "particles at the guarded Hugoniot pole"});
    });
    if (is_there(archive, "interfaces"))
      list(archive, "interfaces", "A face of the charge on which a body can slide", mechanics.interfaces,
           [&](auto& faces) { lay_out_interface(archive, faces); });
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
  if constexpr (!Archive::reading) {
    const std::string name = station < trace.stations.size() ? trace.stations[station].name : "";
    archive.value("station_name", name, {"none", "name of the station"});
  }
}

template <class Archive>
void lay_out_ignition(Archive& archive, auto& ignition, const trace::BottomTrace& trace) {
  optional_group(
      archive, "ignition", "First ignition; absent when there is none", ignition, [&](auto& first) {
        archive.value("time", first.time, {"s", "time of ignition"});
        lay_out_station(archive, first.station, trace);
        choice(archive, "cause", first.cause, ignition_cause_names,
               {"none", "trigger: T1 by heating from outside"});
        archive.value("chemical_share", first.chemical_share, {"1", "Arrhenius share of the heating at T1"});
      });
}

template <class Archive>
void lay_out_combustion(Archive& archive, auto& combustion, const trace::BottomTrace& trace) {
  optional_group(
      archive, "combustion", "What followed ignition; absent without two-way coupling", combustion,
      [&](auto& c) {
        choice(archive, "end", c.end, combustion_end_names, {"none", "why the run ended"});
        archive.value("reason", c.reason, {"none", "why it broke off"});
        archive.value("energy_drift", c.energy_drift, {"1", "largest energy drift of the run"});
        archive.value("wall_time", c.wall_time, {"s", "wall time of the run"});
        archive.value("skin_flame_speed", c.skin_flame_speed,
                      {"m/s", "at the first station, through its skin"});
        archive.value("bulk_flame_speed", c.bulk_flame_speed, {"m/s", "the same, behind the skin"});
        archive.value("complete_time", c.complete_time, {"s", "when the skin of some station had burnt"});
        archive.value("energy_residual", c.energy_residual,
                      {"1", "largest energy made or lost over the heat of reaction of what had burnt"});
        archive.array("time", c.time, {"s", "time"});
        const std::size_t count = c.time.size();
        history(archive, "burnt_mass", c.burnt_mass, count, {"kg", "mass of the gas"});
        history(archive, "burnt_depth", c.burnt_depth, count, {"m", "largest depth of a flame"});
        history(archive, "gas_volume", c.gas_volume, count, {"m3", "volume of the gas"});
        history(archive, "gas_temperature", c.gas_temperature, count, {"K", "mean over the gas's mass"});
        history(archive, "pressure", c.pressure, count, {"Pa", "mean over the bottom"});
        history(archive, "released", c.released, count, {"J", "heat of reaction released"});
        history(archive, "kept_back", c.kept_back, count, {"J", "heat of reaction that was not released"});
        history(archive, "brought", c.brought, count,
                {"J", "heat above the initial temperature that the burnt part had before"});
        archive.table("reaction_degree", c.reaction_degree, {count, trace.stations.size()},
                      {"1", "of the skin; rows are times, columns stations"});
        if (is_there(archive, "snapshots", !c.snapshots.empty()))
          list(archive, "snapshots", "Particle fields at one time", c.snapshots,
               [&](auto& snapshot) { lay_out_snapshot(archive, snapshot); });
      });
}

template <class Archive>
void lay_out_closing(Archive& archive, auto& closing) {
  optional_group(
      archive, "closing", "How the gap closed; absent where it does nothing to the mechanics", closing,
      [&](auto& c) {
        archive.value("smallest_opening", c.smallest_opening, {"m", "anywhere on the bottom"});
        archive.value("contact_time", c.contact_time,
                      {"s", "when the faces first met; none if they did not"});
        archive.value("approach_speed", c.approach_speed, {"m/s", "largest until then"});
        integer(archive, "contacts", c.contacts, {"1", "how often the faces met after touching nowhere"});
        archive.value("largest_gas_pressure", c.largest_gas_pressure, {"Pa", "anywhere"});
        archive.value("largest_gas_temperature", c.largest_gas_temperature,
                      {"K", "mean over the air at a place"});
        archive.value(
            "work_on_gas", c.work_on_gas,
            {"J/m2", "of the faces, beyond the surrounding pressure; mean over the bottom, as below"});
        archive.value("heat_to_charge", c.energy.charge, {"J/m2", "gained by the charge"});
        archive.value("heat_to_base", c.energy.base, {"J/m2", "gained by the base"});
        archive.value("gas_enthalpy", c.energy.gas, {"J/m2", "gained by the air"});
        archive.value("compression", c.energy.work, {"J/m2", "integral of V dp over the air"});
        archive.value("friction_heat", c.energy.friction, {"J/m2", "in the charge"});
        archive.value("reaction_heat", c.energy.reaction, {"J/m2", "in the charge"});
        archive.array("time", c.time, {"s", "time"});
        history(archive, "opening", c.opening, c.time.size(), {"m", "mean over the bottom"});
        history(archive, "gas_pressure", c.gas_pressure, c.time.size(), {"Pa", "mean over the bottom"});
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
    archive.value("stored", air.stored, {"J/m2", "stored in the air by adiabatic compression"});
    archive.value("isothermal", air.isothermal, {"J/m2", "work of isothermal compression"});
  });
}

template <class Archive, class Value>
void lay_out_gap(Archive& archive, Value& gap, const trace::BottomTrace& trace) {
  auto& skin = gap.skin;
  archive.value("gap", gap.gap, {"m", "thickness of the bottom gap"});
  archive.value("sampling_error", gap.sampling_error, {"K", "change of T_max on a trace thinned by two"});
  integer(archive, "coupled", gap.with_mechanics, {"1", "1 when integrated inside the mechanics"});
  lay_out_maximum(archive, "maximum_at_stations", "T_max over the stations, which tile the bottom",
                  gap.at_stations, trace);
  lay_out_maximum(archive, "maximum_at_points", "T_max over the observation points", gap.at_points, trace);
  lay_out_ignition(archive, skin.ignition, trace);
  lay_out_closing(archive, gap.closing);
  lay_out_combustion(archive, gap.combustion, trace);
  if (is_there(archive, "air_energy")) lay_out_air_energy(archive, gap.air);
  archive.group("skin", "Skin temperatures", [&] {
    archive.value("gap", skin.gap, {"m", "gap of this history"});
    archive.value("energy_residual", skin.energy_residual,
                  {"1", "energy residual relative to the heat exchanged"});
    archive.array("time", skin.time, {"s", "time"});
    history(archive, "air_temperature", skin.air_temperature, skin.time.size(),
            {"K", "temperature of the gap's air"});
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
