#include "layout.hpp"

#include <numeric>

namespace launchsafe::store {
namespace {

using run::BottomSkin, run::FaceSnapshot, run::Snapshot, run::Stored;

constexpr std::tuple snapshot_members{
    Stored{"time", &Snapshot::time, "s"},
    Stored{"body", &Snapshot::body, "1"},  // index, in the order of the bodies in manifest/input
    Stored{"x", &Snapshot::x, "m"},
    Stored{"r", &Snapshot::r, "m"},
    Stored{"velocity_x", &Snapshot::velocity_x, "m/s"},
    Stored{"velocity_r", &Snapshot::velocity_r, "m/s"},
    Stored{"bottom_x", &Snapshot::bottom_x, "m"},
    Stored{"bottom_r", &Snapshot::bottom_r, "m"},
};
constexpr std::tuple skin_members{
    Stored{"gap", &BottomSkin::gap, "m"},
    Stored{"temperature", &BottomSkin::temperature, "K"},
    Stored{"reaction_degree", &BottomSkin::reaction_degree, "1"},
};
constexpr std::tuple face_members{
    Stored{"body", &FaceSnapshot::body, "none"},
    Stored{"x", &FaceSnapshot::x, "m"},
    Stored{"r", &FaceSnapshot::r, "m"},
    Stored{"slip", &FaceSnapshot::slip, "m"},
    Stored{"contact_pressure", &FaceSnapshot::pressure, "Pa"},
    Stored{"shear", &FaceSnapshot::shear, "Pa"},
    Stored{"opening", &FaceSnapshot::opening, "m"},
};

void lay_out_events(Hdf5& file, const std::string& name, std::vector<scene::Event>& events) {
  std::vector<std::string> words;
  for (const scene::Event event : events) words.push_back(scene::word_of(event));
  file.data(name, words, "none");
  events.clear();
  for (const std::string& word : words) {
    const auto found = std::ranges::find(scene::event_words(), word);
    if (found == scene::event_words().end()) file.fail(name + " has '" + word + "', which is no event");
    events.push_back(static_cast<scene::Event>(found - scene::event_words().begin()));
  }
}

/// The cells of the particles, for ParaView alone: four corners, once around each, as rows of x and r.
void write_cells(Hdf5& file, const std::string& at, const Snapshot& snapshot) {
  std::vector<double> corners;
  for (std::size_t i = 0; i < snapshot.x.size(); ++i) {
    const double left = snapshot.x[i] - snapshot.half_length_x[i],
                 right = snapshot.x[i] + snapshot.half_length_x[i],
                 inside = snapshot.r[i] - snapshot.half_length_r[i],
                 outside = snapshot.r[i] + snapshot.half_length_r[i];
    corners.insert(corners.end(), {left, inside, right, inside, right, outside, left, outside});
  }
  std::vector<int> cells(corners.size() / 2);
  std::iota(cells.begin(), cells.end(), 0);
  file.table(at + "corners", corners, cells.size(), 2, "m");
  file.data(at + "cells", cells, "1");
}

}  // namespace

void lay_out(Hdf5& file, const std::string& at, Snapshot& snapshot) {
  lay_out_events(file, at + "events", snapshot.events);
  members(file, at, snapshot, snapshot_members);
  for (const run::SnapshotField& field : run::snapshot_fields()) {
    const std::string name = at + std::string(field.name);
    const bool is_there =
        file.reading() ? file.has(name) : !values_of(std::as_const(snapshot), field).empty();
    if (!field.always && !is_there) continue;
    std::vector<double>& values = values_of(snapshot, field);
    file.data(name, values, std::string(field.unit).c_str());
    if (values.size() != snapshot.body.size()) file.fail(name + " is not of every particle");
  }
  list(file, at + "skins/", snapshot.skins,
       [&](const std::string& in, BottomSkin& skin) { members(file, in, skin, skin_members); });
  list(file, at + "faces/", snapshot.faces,
       [&](const std::string& in, FaceSnapshot& face) { members(file, in, face, face_members); });
  if (!file.reading()) write_cells(file, at, snapshot);
}

}  // namespace launchsafe::store
