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

std::string vector_item(const std::string& address, std::size_t count) {
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{} 3\">{}</DataItem>",
      count, address);
}

std::string grid_of(const run::Snapshot& snapshot, const std::string& group) {
  const std::size_t count = snapshot.body.size();
  std::string grid = fmt::format(
      "      <Grid Name=\"particles\" GridType=\"Uniform\">\n"
      "        <Time Value=\"{}\"/>\n"
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
      "        <Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem Format=\"HDF\" "
      "NumberType=\"Int\" Precision=\"8\" Dimensions=\"{}\">{}/body</DataItem></Attribute>\n",
      snapshot.time, count, vector_item(group + "/position", count), count, group);
  if (!snapshot.velocity_x.empty()) {
    grid += fmt::format(
        "        <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n",
        vector_item(group + "/velocity", count));
  }
  for (const ParticleField& field : particle_fields) {
    if ((snapshot.*field.values).empty()) continue;
    grid += fmt::format(
        "        <Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem Format=\"HDF\" "
        "NumberType=\"Float\" Precision=\"8\" Dimensions=\"{1}\">{2}/{0}</DataItem></Attribute>\n",
        field.name, count, group);
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
