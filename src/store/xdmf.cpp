#include "layout.hpp"

namespace launchsafe::store {
namespace {

/// A dataset of the case file.
std::string item(std::string_view type, const std::string& dimensions, const std::string& address) {
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">{}</DataItem>", type,
      type == "Int" ? sizeof(int) : sizeof(double), dimensions, address);
}

std::string attribute(std::string_view name, const std::string& data) {
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n", name, data);
}

/// Particles as quadrilaterals with corners of their own, named after the snapshot's events. `group`:
/// "case.h5:/snapshots/0000/".
std::string grid(const run::Snapshot& snapshot, const std::string& group) {
  std::string events;
  for (const scene::Event event : snapshot.events) events += (events.empty() ? ": " : ", ") + word_of(event);
  const std::size_t count = snapshot.body.size();
  const std::string one = fmt::format("{}", count), corners = fmt::format("{}", 4 * count);
  std::string text = fmt::format(
      "      <Grid Name=\"particles{}\" GridType=\"Uniform\">\n"
      "        <Time Value=\"{}\"/>\n"
      "        <Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
      events, snapshot.time, count, item("Int", corners, group + "cells"),
      item("Float", corners + " 2", group + "corners"));
  text += attribute("body", item("Int", one, group + "body"));
  for (const char* name : {"velocity_x", "velocity_r"})
    text += attribute(name, item("Float", one, group + name));
  for (const run::SnapshotField& field : run::snapshot_fields())
    if (!values_of(snapshot, field).empty())
      text += attribute(field.name, item("Float", one, group + std::string(field.name)));
  return text + "      </Grid>\n";
}

/// Nothing without snapshots. `list`: "case.h5:/snapshots".
std::string series(const std::string& name, const std::vector<run::Snapshot>& snapshots,
                   const std::string& list) {
  if (snapshots.empty()) return {};
  std::string grids;
  for (std::size_t i = 0; i < snapshots.size(); ++i)
    grids += grid(snapshots[i], fmt::format("{}/{:04}/", list, i));
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n", name,
      grids);
}

}  // namespace

std::string xdmf_of(const run::CaseResult& result, const std::string& case_file) {
  std::string all = series("launch", result.mechanics.snapshots, case_file + ":/snapshots");
  for (std::size_t i = 0; i < result.gaps.size(); ++i)
    if (const auto& combustion = result.gaps[i].combustion)
      all += series(fmt::format("launch, burning, gap {:.6g} cm", 100.0 * result.gaps[i].gap),
                    combustion->snapshots, fmt::format("{}:/gaps/{:04}/combustion/snapshots", case_file, i));
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n" + all + "  </Domain>\n</Xdmf>\n";
}

}  // namespace launchsafe::store
