#include "xdmf.hpp"

#include "case_layout.hpp"

#include <fmt/format.h>

#include <array>

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

/// Each particle a quadrilateral with corners of its own; a point where the cells are not known.
std::string mesh_of(const run::Snapshot& snapshot, const std::string& group) {
  const std::size_t count = snapshot.body.size();
  if (!has_cells(snapshot))
    return fmt::format(
        "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{0}\" NodesPerElement=\"1\"/>\n"
        "        <Geometry GeometryType=\"XYZ\">{1}</Geometry>\n",
        count, item("Float", fmt::format("{} 3", count), group + "/position"));
  return fmt::format(
      "        <Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
      count, item("Int", fmt::format("{}", 4 * count), group + "/cells"),
      item("Float", fmt::format("{} 2", 4 * count), group + "/corners"));
}

std::string grid_of(const run::Snapshot& snapshot, const std::string& group) {
  const std::size_t count = snapshot.body.size();
  const std::string one = fmt::format("{}", count), three = fmt::format("{} 3", count);
  const std::string_view centre = has_cells(snapshot) ? "Cell" : "Node";
  std::string grid = fmt::format(
                         "      <Grid Name=\"particles\" GridType=\"Uniform\">\n"
                         "        <Time Value=\"{}\"/>\n",
                         snapshot.time) +
                     mesh_of(snapshot, group) +
                     attribute("body", "Scalar", centre, item("Int", one, group + "/body"));
  if (!snapshot.velocity_x.empty())
    grid += attribute("velocity", "Vector", centre, item("Float", three, group + "/velocity"));
  for (const ParticleField& field : particle_fields) {
    if ((snapshot.*field.values).empty()) continue;
    grid += attribute(field.name, "Scalar", centre, item("Float", one, group + "/" + field.name));
  }
  return grid + "      </Grid>\n";
}

}  // namespace

std::string xdmf_of(const std::vector<run::Snapshot>& snapshots, const std::string& case_file) {
  std::string grids;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    grids += grid_of(snapshots[i], fmt::format("{}:/snapshots/{:04}", escaped(case_file), i));
  }
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<Xdmf Version=\"2.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"launch\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
      "{}"
      "    </Grid>\n"
      "  </Domain>\n"
      "</Xdmf>\n",
      grids);
}

}  // namespace launchsafe::store
