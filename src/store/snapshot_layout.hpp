// Where everything is in the group of a snapshot, and the parts that the layouts of stored files are made of.
// Each function serves writing and reading: `Archive` is Hdf5Writer with const values, or Hdf5Reader with
// values to fill.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <fmt/format.h>

#include <numeric>

namespace launchsafe::store {

/// A number of any integral type.
template <class Archive, class Number>
void integer(Archive& archive, const std::string& name, Number& value, const Label& label) {
  std::int64_t stored = static_cast<std::int64_t>(value);
  archive.value(name, stored, label);
  if constexpr (Archive::reading) value = static_cast<Number>(stored);
}

/// An enumerator by its word; `words` are in the order of the enumeration.
template <class Archive, class Value, class Words>
void choice(Archive& archive, const std::string& name, Value& value, const Words& words, const Label& label) {
  std::string text;
  if constexpr (!Archive::reading) text = words.at(static_cast<std::size_t>(value));
  archive.value(name, text, label);
  if constexpr (Archive::reading) {
    const auto found = std::ranges::find(words, text);
    if (found == words.end()) archive.fail(name + " is '" + text + "', which this program does not know");
    value = static_cast<Value>(found - words.begin());
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
    if (rows.size() != values.size()) archive.fail(name + " has another length than the columns before it");
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::invoke(member, rows[i]) = static_cast<Value>(values[i]);
  }
}

/// Whether to lay out what some results lack: written where there is any, read where it is.
template <class Archive>
bool is_there(Archive& archive, const std::string& name, bool any) {
  if constexpr (Archive::reading) return archive.has(name);
  return any;
}

inline constexpr std::array<std::string_view, 3> combustion_end_words{"time", "pressure", "broke_off"};
inline const auto& stored_words(run::CombustionEnd) { return combustion_end_words; }

/// The members of a result that a list describes.
template <class Archive, class Object, class Members>
void lay_out_members(Archive& archive, Object& object, const Members& members) {
  const auto lay_out = [&](const auto& each) {
    auto& value = object.*each.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    const Label label{each.unit, each.meaning};
    if constexpr (std::is_enum_v<Value>) {
      choice(archive, each.name, value, stored_words(value), label);
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      archive.array(each.name, value, label);
    } else if constexpr (std::is_same_v<Value, bool> || std::is_same_v<Value, int>) {
      integer(archive, each.name, value, label);
    } else {
      archive.value(each.name, value, label);
    }
  };
  std::apply([&](const auto&... each) { (lay_out(each), ...); }, members);
}

/// Groups "0000", "0001", ... one for each element.
template <class Archive, class Elements, class Body>
void list(Archive& archive, const std::string& name, const std::string& description, Elements& elements,
          Body body) {
  archive.group(name, description, [&] {
    if constexpr (Archive::reading) elements.resize(archive.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
      archive.group(fmt::format("{:04}", i), description, [&] { body(elements[i]); });
  });
}

/// A group of what some results lack: written where there is any, read where it is.
template <class Archive, class Optional, class Body>
void optional_group(Archive& archive, const std::string& name, const std::string& description, Optional& part,
                    Body body) {
  if constexpr (Archive::reading)
    if (archive.has(name)) part.emplace();
  if (part) archive.group(name, description, [&] { body(*part); });
}

/// Plane vectors as rows of three, the last zero, as visualisation programs want them.
template <class Archive, class Values>
void plane_vectors(Archive& archive, const std::string& name, Values& along, Values& across,
                   std::size_t count, const Label& label) {
  std::vector<double> rows;
  if constexpr (!Archive::reading) {
    if (along.size() != across.size()) archive.fail(name + " has components of different lengths");
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
    archive.array("temperature", skin.temperature,
                  {"K", "temperature of the skin, which holds the heat of its sliding layers"});
    archive.array("reaction_degree", skin.reaction_degree, {"1", "of the skin"});
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
  archive.array("contact_pressure", face.pressure, {"Pa", "normal traction, compression positive"});
  archive.array("shear", face.shear, {"Pa", "traction on the body in the direction of the slip"});
  archive.array("opening", face.opening, {"m", "by which the faces have parted"});
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
      if (found == known.end()) archive.fail("events has '" + word + "', which this program does not know");
      snapshot.events.push_back(static_cast<scene::Event>(found - known.begin()));
    }
  }
}

template <class Archive, class Value>
void lay_out_snapshot(Archive& archive, Value& snapshot) {
  archive.value("time", snapshot.time, {"s", "time of the snapshot"});
  lay_out_events(archive, snapshot);
  if (is_there(archive, "bottom", !snapshot.bottom_x.empty()))
    archive.group("bottom", "The charge's bottom", [&] { lay_out_bottom(archive, snapshot); });
  if (is_there(archive, "faces", !snapshot.faces.empty()))
    list(archive, "faces", "A face of the charge on which a body can slide", snapshot.faces,
         [&](auto& face) { lay_out_face(archive, face); });
  std::vector<std::int64_t> body(snapshot.body.begin(), snapshot.body.end());
  archive.array("body", body, {"1", "index of the body, in the order of those in manifest/input"});
  if constexpr (Archive::reading) snapshot.body.assign(body.begin(), body.end());
  const std::size_t count = body.size();
  plane_vectors(archive, "position", snapshot.x, snapshot.r, count, {"m", "axial, radial, 0"});
  plane_vectors(archive, "velocity", snapshot.velocity_x, snapshot.velocity_r, count,
                {"m/s", "axial, radial, 0; relative to the frame"});
  for (const run::SnapshotField& field : run::snapshot_fields()) {
    const std::string name(field.name);
    if (!field.always && !is_there(archive, name, !values_of(std::as_const(snapshot), field).empty()))
      continue;
    auto& values = values_of(snapshot, field);
    archive.array(name, values,
                  {std::string(field.unit),
                   std::string(field.description.empty() ? field.meaning : field.description)});
    if (values.size() != count) archive.fail(name + " is not of every particle");
  }
  if constexpr (!Archive::reading) {
    archive.table("stress", stresses_of(snapshot), {count, 6},
                  {"Pa", "positive in tension: xx, xr, 0, rr, 0, hoop"});
    archive.table("corners", corners_of(snapshot), {4 * count, 2},
                  {"m", "axial, radial; the four corners of every particle's cell, once around"});
    archive.array("cells", counted_up(4 * count),
                  {"1", "rows of corners, four a cell, as visualisation programs want them"});
  }
}

/// The description by which ParaView finds the snapshots in a case file: an XDMF document of time series. The
/// particles as quadrilateral cells with values on cells; the charge's bottom as a line a station with the
/// skins of all gaps on it; each face that can slide as a chain of lines with values at its nodes; and the
/// same of every gap that burns. `case_file` is the case file's name without its folder.
std::string xdmf_of(const run::CaseResult& result, const std::string& case_file);

}  // namespace launchsafe::store
