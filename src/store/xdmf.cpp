#include "snapshot_layout.hpp"

namespace launchsafe::store {
namespace {

std::string escaped(std::string_view text) {
  constexpr std::string_view special = "&<>\"";
  constexpr std::array entities{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string result;
  for (const char character : text) {
    const std::size_t found = special.find(character);
    result += found == std::string_view::npos ? std::string(1, character) : entities[found];
  }
  return result;
}

/// A snapshot in the case file.
struct Stored {
  const run::Snapshot& snapshot;
  std::string group;  ///< "case.h5:/snapshots/0000"
};

/// A dataset of the case file.
std::string item(std::string_view type, const std::string& dimensions, const std::string& address) {
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"8\" Dimensions=\"{}\">{}</DataItem>", type,
      dimensions, address);
}

/// `centre`: Cell or Node.
std::string attribute(std::string_view name, std::string_view kind, std::string_view centre,
                      const std::string& data) {
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                     name, kind, centre, data);
}

/// Numbers that have one dimension.
std::string scalar(std::string_view name, std::string_view centre, std::size_t count,
                   const std::string& address) {
  return attribute(name, "Scalar", centre, item("Float", fmt::format("{}", count), address));
}

/// Each particle a quadrilateral with corners of its own.
std::string mesh_of(const Stored& stored) {
  const std::size_t count = stored.snapshot.body.size();
  return fmt::format(
      "        <Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
      count, item("Int", fmt::format("{}", 4 * count), stored.group + "/cells"),
      item("Float", fmt::format("{} 2", 4 * count), stored.group + "/corners"));
}

/// Lines between pairs of points.
std::string lines_between(std::size_t points, std::size_t lines, const std::string& links,
                          const std::string& places) {
  return fmt::format(
      "        <Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" "
      "NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      lines, item("Int", fmt::format("{}", 2 * lines), links),
      item("Float", fmt::format("{} 3", points), places));
}

/// A grid at the time of a snapshot, named after what it is and the snapshot's events.
std::string grid(const std::string& name, const run::Snapshot& snapshot, const std::string& content) {
  std::string events;
  for (const scene::Event event : snapshot.events) events += (events.empty() ? "" : ", ") + word_of(event);
  std::string text = fmt::format("      <Grid Name=\"{}{}\" GridType=\"Uniform\">\n", name,
                                 events.empty() ? "" : ": " + events);
  if (!events.empty()) text += fmt::format("        <Information Name=\"events\" Value=\"{}\"/>\n", events);
  return text + fmt::format("        <Time Value=\"{}\"/>\n", snapshot.time) + content + "      </Grid>\n";
}

std::string particles_of(const Stored& stored) {
  const auto& [snapshot, group] = stored;
  const std::size_t count = snapshot.body.size();
  const std::string one = fmt::format("{}", count);
  std::string text = mesh_of(stored) +
                     attribute("body", "Scalar", "Cell", item("Int", one, group + "/body")) +
                     attribute("velocity", "Vector", "Cell", item("Float", one + " 3", group + "/velocity")) +
                     attribute("stress", "Tensor6", "Cell", item("Float", one + " 6", group + "/stress"));
  for (const run::SnapshotField& field : run::snapshot_fields()) {
    if (values_of(snapshot, field).empty()) continue;
    text += scalar(field.name, "Cell", count, fmt::format("{}/{}", group, field.name));
  }
  return text;
}

std::string bottom_of(const Stored& stored) {
  const std::string group = stored.group + "/bottom";
  const std::size_t stations = stored.snapshot.bottom_x.size() / 2;
  std::string text = lines_between(2 * stations, stations, group + "/lines", group + "/points");
  for (std::size_t i = 0; i < stored.snapshot.skins.size(); ++i) {
    const run::BottomSkin& skin = stored.snapshot.skins[i];
    const std::string gap = fmt::format("{:.6g} cm", 100.0 * skin.gap),
                      place = fmt::format("{}/gaps/{:04}/", group, i);
    text += scalar("skin temperature, gap " + gap, "Cell", stations, place + "temperature");
    if (!skin.reaction_degree.empty())
      text += scalar("reaction degree, gap " + gap, "Cell", stations, place + "reaction_degree");
  }
  return text;
}

std::string face_of(const Stored& stored, std::size_t index) {
  const std::string group = fmt::format("{}/faces/{:04}", stored.group, index);
  const std::size_t nodes = stored.snapshot.faces[index].slip.size();
  std::string text = lines_between(nodes, nodes - 1, group + "/lines", group + "/position");
  for (const char* name : {"slip", "contact_pressure", "shear", "opening"})
    text += scalar(name, "Node", nodes, group + "/" + name);
  return text;
}

/// A time series; nothing without grids.
std::string series(const std::string& name, const std::string& grids) {
  if (grids.empty()) return {};
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n", name,
      grids);
}

/// The particles of a list of snapshots, the bottom of the charge, and each face that can slide, as time
/// series of their own. `end` of their names.
std::string all_series(const std::vector<run::Snapshot>& snapshots, const std::string& list,
                       const std::string& end) {
  std::string particles, bottom;
  std::vector<std::string> faces;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    const Stored stored{snapshots[i], fmt::format("{}/{:04}", list, i)};
    particles += grid("particles", snapshots[i], particles_of(stored));
    if (!snapshots[i].bottom_x.empty()) bottom += grid("bottom", snapshots[i], bottom_of(stored));
    faces.resize(std::max(faces.size(), snapshots[i].faces.size()));
    for (std::size_t f = 0; f < snapshots[i].faces.size(); ++f)
      faces[f] += grid("face", snapshots[i], face_of(stored, f));
  }
  std::string text = series("launch" + end, particles) + series("bottom of the charge" + end, bottom);
  for (std::size_t f = 0; f < faces.size(); ++f)
    text += series(fmt::format("face {} towards {}{}", f + 1, escaped(snapshots.back().faces[f].body), end),
                   faces[f]);
  return text;
}

}  // namespace

std::string xdmf_of(const run::CaseResult& result, const std::string& case_file) {
  const std::string file = escaped(case_file) + ":";
  std::string grids = all_series(result.mechanics.snapshots, file + "/snapshots", "");
  for (std::size_t i = 0; i < result.gaps.size(); ++i)
    if (const auto& combustion = result.gaps[i].combustion)
      grids += all_series(combustion->snapshots, fmt::format("{}/gaps/{:04}/combustion/snapshots", file, i),
                          fmt::format(", burning, gap {:.6g} cm", 100.0 * result.gaps[i].gap));
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<Xdmf Version=\"2.0\">\n"
      "  <Domain>\n"
      "{}"
      "  </Domain>\n"
      "</Xdmf>\n",
      grids);
}

}  // namespace launchsafe::store
