// Where everything is in a case file. Each function serves writing and reading: `Archive` is Hdf5Writer with
// const values, or Hdf5Reader with values to fill.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/hdf5.hpp"
#include "launchsafe/store/manifest.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace launchsafe::store {

template <class Enumeration>
struct Named {
  Enumeration value;
  const char* name;
};

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
/// By closure of the friction; "literal" is the total strain rate, under the name that stored cases have.
inline constexpr std::array<const char*, trace::traced_closures> closure_names{"literal", "inelastic"};

/// A number of any integral type.
template <class Archive, class Number>
void integer(Archive& archive, const std::string& name, Number& value, const Label& label) {
  std::int64_t stored = static_cast<std::int64_t>(value);
  archive.value(name, stored, label);
  if constexpr (Archive::reading) {
    value = static_cast<Number>(stored);
    if (static_cast<std::int64_t>(value) != stored) archive.fail(name + " is out of range");
  }
}

/// An enumerator by its name.
template <class Archive, class Value, class Names>
void choice(Archive& archive, const std::string& name, Value& value, const Names& names, const Label& label) {
  std::string text;
  for (const auto& each : names) {
    if (each.value == value) text = each.name;
  }
  archive.value(name, text, label);
  if constexpr (Archive::reading) {
    for (const auto& each : names) {
      if (text == each.name) {
        value = each.value;
        return;
      }
    }
    archive.fail(name + " is '" + text + "', which this program does not know");
  }
}

/// One member of every row as an array; the first column read decides how many rows there are.
template <class Archive, class Rows, class Member>
void column(Archive& archive, const std::string& name, Rows& rows, Member member, const Label& label) {
  using Row = typename std::remove_const_t<Rows>::value_type;
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, Row&>>;
  using Stored = std::conditional_t<std::is_integral_v<Value>, std::int64_t, Value>;
  std::vector<Stored> values;
  if constexpr (!Archive::reading) {
    values.reserve(rows.size());
    for (const auto& row : rows) values.push_back(static_cast<Stored>(std::invoke(member, row)));
    archive.array(name, values, label);
  } else {
    archive.array(name, values, label);
    if (rows.empty()) rows.resize(values.size());
    if (rows.size() != values.size())
      return archive.fail(name + " has another length than the columns before it");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::invoke(member, rows[i]) = static_cast<Value>(values[i]);
      if constexpr (std::is_integral_v<Value>) {
        if (static_cast<Stored>(std::invoke(member, rows[i])) != values[i])
          return archive.fail(name + " is out of range");
      }
    }
  }
}

/// An array that is as long as the times it belongs to, or empty where it was not recorded.
template <class Archive, class Values>
void history(Archive& archive, const std::string& name, Values& values, std::size_t length,
             const Label& label) {
  archive.array(name, values, label);
  if (!values.empty() && values.size() != length) archive.fail(name + " has another length than its times");
}

/// Groups "0000", "0001", ... one for each element.
template <class Archive, class Elements, class Body>
void list(Archive& archive, const std::string& name, const std::string& description, Elements& elements,
          Body body) {
  archive.group(name, description, [&] {
    if constexpr (Archive::reading) elements.resize(archive.size());
    for (std::size_t i = 0; i < elements.size() && !archive.failed(); ++i) {
      const std::string digits = std::to_string(i);
      const std::string group = std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
      archive.group(group, description, [&] { body(elements[i]); });
    }
  });
}

/// Plane vectors as rows of three, the last zero, as visualisation programs want them.
template <class Archive, class Values>
void plane_vectors(Archive& archive, const std::string& name, Values& along, Values& across,
                   std::size_t count, const Label& label) {
  std::vector<double> rows;
  if constexpr (!Archive::reading) {
    if (along.size() != across.size()) return archive.fail(name + " has components of different lengths");
    for (std::size_t i = 0; i < along.size(); ++i) rows.insert(rows.end(), {along[i], across[i], 0.0});
    archive.table(name, rows, {count, 3}, label);
  } else {
    archive.table(name, rows, {count, 3}, label);
    for (std::size_t i = 0; i + 2 < rows.size(); i += 3) {
      along.push_back(rows[i]);
      across.push_back(rows[i + 1]);
    }
  }
}

/// Whether to lay out what older files lack: written always, read where it is.
template <class Archive>
bool is_stored(Archive& archive, const std::string& name) {
  if constexpr (Archive::reading) return archive.has(name);
  return true;
}

/// Whether to lay out what some results lack: written where there is any, read where it is.
template <class Archive, class Values>
bool is_recorded(Archive& archive, const std::string& name, const Values& values) {
  if constexpr (Archive::reading) return archive.has(name);
  return !values.empty();
}

template <class Archive, class Value>
void lay_out_manifest(Archive& archive, Value& manifest) {
  archive.group("manifest", "Where this result came from", [&] {
    archive.value("input", manifest.input_text, {"none", "all that determines the case"});
    archive.value("input_sha256", manifest.input_sha256, {"none", "SHA-256 of the input"});
    if (is_stored(archive, "model_version"))
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
  for (std::size_t closure = 0; closure < closure_names.size(); ++closure) {
    archive.table(
        std::string("friction_") + closure_names[closure], trace.friction[closure],
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
  if (is_stored(archive, "contact_loss"))
    energy("contact_loss", &EnergyBalance::contact,
           "taken out by friction between bodies, and where their faces close");
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

/// Whether files hold a quantity of snapshots always, or where it was recorded: older ones do without.
enum class Kept { always, where_recorded };

/// A quantity that snapshots may hold of every particle.
struct ParticleField {
  const char* name;
  std::vector<double> run::Snapshot::*values;
  const char* units;
  const char* description;
  Kept kept = Kept::always;
};
inline constexpr std::array particle_fields{
    ParticleField{"density", &run::Snapshot::density, "kg/m3", "density"},
    ParticleField{"pressure", &run::Snapshot::pressure, "Pa", "pressure, compression positive"},
    ParticleField{"von_mises", &run::Snapshot::von_mises, "Pa", "von Mises stress"},
    ParticleField{
        "deviator_rr", &run::Snapshot::deviator_rr, "Pa",
        "radial stress deviator; the stress, positive in tension, is deviator_rr - pressure; of the "
        "hoop -(deviator_rr + deviator_xx) - pressure"},
    ParticleField{"deviator_xx", &run::Snapshot::deviator_xx, "Pa",
                  "axial stress deviator; the stress, positive in tension, is deviator_xx - pressure"},
    ParticleField{"deviator_rx", &run::Snapshot::deviator_rx, "Pa", "shear stress"},
    ParticleField{"temperature", &run::Snapshot::temperature, "K", "temperature"},
    ParticleField{"crack_radius", &run::Snapshot::crack_radius, "m", "crack radius", Kept::where_recorded},
    ParticleField{"plastic_strain", &run::Snapshot::plastic_strain, "1", "equivalent plastic strain",
                  Kept::where_recorded},
    ParticleField{"half_length_x", &run::Snapshot::half_length_x, "m",
                  "of the particle's cell at present, axial", Kept::where_recorded},
    ParticleField{"half_length_r", &run::Snapshot::half_length_r, "m",
                  "of the particle's cell at present, radial", Kept::where_recorded},
    ParticleField{"burnt_share", &run::Snapshot::burnt_share, "1", "burnt share of the particle's mass",
                  Kept::where_recorded},
};

/// Whether snapshots hold the cells of their particles.
inline bool has_cells(const run::Snapshot& snapshot) {
  return !snapshot.x.empty() && snapshot.half_length_x.size() == snapshot.x.size() &&
         snapshot.half_length_r.size() == snapshot.x.size();
}

/// The corners of the particles' cells, once around each, as rows of x and r.
inline std::vector<double> corners_of(const run::Snapshot& snapshot) {
  std::vector<double> corners;
  corners.reserve(8 * snapshot.x.size());
  for (std::size_t i = 0; i < snapshot.x.size(); ++i) {
    const double left = snapshot.x[i] - snapshot.half_length_x[i],
                 right = snapshot.x[i] + snapshot.half_length_x[i],
                 inside = snapshot.r[i] - snapshot.half_length_r[i],
                 outside = snapshot.r[i] + snapshot.half_length_r[i];
    corners.insert(corners.end(), {left, inside, right, inside, right, outside, left, outside});
  }
  return corners;
}

/// The stresses of all particles, positive in tension, as rows of a symmetric tensor: xx, xr, 0, rr, 0 and
/// the hoop stress.
inline std::vector<double> stresses_of(const run::Snapshot& snapshot) {
  std::vector<double> rows;
  rows.reserve(6 * snapshot.x.size());
  for (std::size_t i = 0; i < snapshot.x.size(); ++i) {
    const double xx = snapshot.deviator_xx[i], rr = snapshot.deviator_rr[i], p = snapshot.pressure[i];
    rows.insert(rows.end(), {xx - p, snapshot.deviator_rx[i], 0.0, rr - p, 0.0, -(xx + rr) - p});
  }
  return rows;
}
/// Whether snapshots hold all stresses of their particles.
inline bool has_stresses(const run::Snapshot& snapshot) {
  const std::size_t count = snapshot.x.size();
  return count > 0 && snapshot.deviator_xx.size() == count && snapshot.deviator_rr.size() == count &&
         snapshot.deviator_rx.size() == count && snapshot.pressure.size() == count;
}

/// 0, 1, 2, ...: corners that each belong to one cell alone.
inline std::vector<std::int64_t> counted_up(std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// The pairs of neighbours in a chain of nodes.
inline std::vector<std::int64_t> links_of(std::size_t nodes) {
  std::vector<std::int64_t> links;
  for (std::size_t i = 1; i < nodes; ++i)
    links.insert(links.end(), {static_cast<std::int64_t>(i) - 1, static_cast<std::int64_t>(i)});
  return links;
}

/// The stations' part of the charge's bottom, each a line with the skin temperatures of all gaps on it.
template <class Archive, class Value>
void lay_out_bottom(Archive& archive, Value& snapshot) {
  auto &x = snapshot.bottom_x, &r = snapshot.bottom_r;
  std::vector<double> middles;
  for (std::size_t i = 0; i + 1 < r.size(); i += 2) middles.push_back(0.5 * (r[i] + r[i + 1]));
  archive.array("r", middles, {"m", "of the stations' middles at present"});
  const std::size_t stations = middles.size();
  plane_vectors(archive, "points", x, r, 2 * stations,
                {"m", "axial, radial, 0; both ends of every station at present, station after station"});
  if constexpr (!Archive::reading)
    archive.array("lines", counted_up(2 * stations), {"1", "rows of points, two a station"});
  list(archive, "gaps", "The skin of one gap, by station", snapshot.skins, [&](auto& skin) {
    archive.value("gap", skin.gap, {"m", "thickness of the gap"});
    history(archive, "temperature", skin.temperature, stations,
            {"K", "temperature of the skin, which holds the heat of its sliding layers"});
    history(archive, "reaction_degree", skin.reaction_degree, stations, {"1", "of the skin"});
  });
}

template <class Archive, class Value>
void lay_out_face(Archive& archive, Value& face) {
  archive.value("body", face.body, {"none", "the body that touches the charge"});
  archive.array(
      "slip", face.slip,
      {"m", "of the body against the charge since the start: along x on a side, along r on an end"});
  const std::size_t nodes = face.slip.size();
  plane_vectors(archive, "position", face.x, face.r, nodes, {"m", "axial, radial, 0; of the charge's face"});
  history(archive, "contact_pressure", face.pressure, nodes, {"Pa", "normal traction, compression positive"});
  history(archive, "shear", face.shear, nodes, {"Pa", "traction on the body in the direction of the slip"});
  history(archive, "opening", face.opening, nodes, {"m", "by which the faces have parted"});
  if constexpr (!Archive::reading)
    archive.array("lines", links_of(nodes), {"1", "rows of the position, two a line"});
}

/// The words of the events of a snapshot, "a, b".
template <class Archive, class Value>
void lay_out_events(Archive& archive, Value& snapshot) {
  std::vector<std::string> words;
  for (const scene::Event event : snapshot.events) words.push_back(scene::word_of(event));
  archive.array("events", words, {"none", "events that it is of; none where it is of a time alone"});
  if constexpr (Archive::reading) {
    const std::vector<std::string>& known = scene::event_words();
    for (const std::string& word : words) {
      const auto found = std::find(known.begin(), known.end(), word);
      if (found == known.end())
        return archive.fail("events has '" + word + "', which this program does not know");
      snapshot.events.push_back(static_cast<scene::Event>(found - known.begin()));
    }
  }
}

template <class Archive, class Value>
void lay_out_snapshot(Archive& archive, Value& snapshot) {
  archive.value("time", snapshot.time, {"s", "time of the snapshot"});
  if (is_stored(archive, "events")) lay_out_events(archive, snapshot);
  if (is_recorded(archive, "bottom", snapshot.bottom_x))
    archive.group("bottom", "The charge's bottom", [&] { lay_out_bottom(archive, snapshot); });
  if (is_recorded(archive, "faces", snapshot.faces))
    list(archive, "faces", "A face of the charge on which a body can slide", snapshot.faces,
         [&](auto& face) { lay_out_face(archive, face); });
  std::vector<std::int64_t> body(snapshot.body.begin(), snapshot.body.end());
  archive.array("body", body, {"1", "index of the body, in the order of scene/bodies"});
  if constexpr (Archive::reading) snapshot.body.assign(body.begin(), body.end());
  const std::size_t count = body.size();
  plane_vectors(archive, "position", snapshot.x, snapshot.r, count, {"m", "axial, radial, 0"});
  plane_vectors(archive, "velocity", snapshot.velocity_x, snapshot.velocity_r, count,
                {"m/s", "axial, radial, 0; relative to the frame"});
  for (const ParticleField& field : particle_fields) {
    auto& values = snapshot.*field.values;
    if (field.kept == Kept::always || is_recorded(archive, field.name, values))
      history(archive, field.name, values, count, {field.units, field.description});
  }
  if constexpr (!Archive::reading) {
    if (has_stresses(snapshot))
      archive.table("stress", stresses_of(snapshot), {count, 6},
                    {"Pa", "positive in tension: xx, xr, 0, rr, 0, hoop"});
    if (!has_cells(snapshot)) return;
    archive.table("corners", corners_of(snapshot), {4 * count, 2},
                  {"m", "axial, radial; the four corners of every particle's cell, once around"});
    archive.array("cells", counted_up(4 * count),
                  {"1", "rows of corners, four a cell, as visualisation programs want them"});
  }
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
    if (is_stored(archive, "steps_before"))
      archive.value("steps_before", mechanics.steps_before,
                    {"1", "of them, up to the checkpoint from which the run went on"});
    archive.value("particles", mechanics.particles, {"1", "particles"});
    archive.value("wall_time", mechanics.wall_time, {"s", "wall time of the mechanics"});
    if constexpr (!Archive::reading) {
      archive.value("update_rate", mechanics.update_rate(), {"1/s", "particle updates per second"});
    }
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
    if (is_stored(archive, "interfaces"))
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
void lay_out_ignition(Archive& archive, const std::string& name, auto& ignition,
                      const trace::BottomTrace& trace) {
  if constexpr (Archive::reading) {
    if (!archive.has(name)) return;
    ignition.emplace();
  } else {
    if (!ignition) return;
  }
  archive.group(name, "First ignition; absent when there is none", [&] {
    archive.value("time", ignition->time, {"s", "time of ignition"});
    lay_out_station(archive, ignition->station, trace);
    choice(archive, "cause", ignition->cause, ignition_cause_names,
           {"none", "trigger: T1 by heating from outside"});
    archive.value("chemical_share", ignition->chemical_share, {"1", "Arrhenius share of the heating at T1"});
  });
}

template <class Archive>
void lay_out_combustion(Archive& archive, auto& combustion, const trace::BottomTrace& trace) {
  if constexpr (Archive::reading) {
    if (!archive.has("combustion")) return;
    combustion.emplace();
  } else {
    if (!combustion) return;
  }
  archive.group("combustion", "What followed ignition; absent without two-way coupling", [&] {
    auto& c = *combustion;
    choice(archive, "end", c.end, combustion_end_names, {"none", "why the run ended"});
    archive.value("reason", c.reason, {"none", "why it broke off"});
    archive.value("energy_drift", c.energy_drift, {"1", "largest energy drift of the run"});
    archive.value("wall_time", c.wall_time, {"s", "wall time of the run"});
    archive.value("skin_flame_speed", c.skin_flame_speed, {"m/s", "at the first station, through its skin"});
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
    if (is_recorded(archive, "snapshots", c.snapshots))
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
  lay_out_ignition(archive, "ignition", skin.ignition, trace);
  lay_out_combustion(archive, gap.combustion, trace);
  if (is_stored(archive, "air_energy")) lay_out_air_energy(archive, gap.air);
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
