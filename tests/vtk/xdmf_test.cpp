// What VTK's own reader, by which ParaView opens them, finds in the files of a run. Label `vtk`.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/case_file.hpp"
#include "small_shell.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace launchsafe::store {
namespace {

constexpr int quadrilateral = 9;  // VTK_QUAD

class Xdmf : public testing::TemporaryFolder {
 protected:
  /// The values of an array at a step of a series, each with one component.
  static std::vector<double> values(const nlohmann::json& array) {
    std::vector<double> all;
    for (const auto& tuple : array) all.push_back(tuple.at(0));
    return all;
  }

  nlohmann::json read(const std::filesystem::path& description) const {
    const std::string command =
        std::string("\"" LAUNCHSAFE_VTK_PYTHON "\" \"" LAUNCHSAFE_SOURCE_DIR "/tests/vtk/read_xdmf.py\" \"") +
        description.string() + "\" > \"" + (folder() / "found.json").string() + "\"";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream found(folder() / "found.json");
    return nlohmann::json::parse(found, nullptr, false);
  }
};

TEST_F(Xdmf, IsATimeSeriesOfCellsWithTheValuesOfTheCase) {
  const auto file = scene::caught([&] {
    return scene::parse_scene(
        testing::small_shell + testing::small_shell_base +
            "[interface.wall]\ncondition = \"sliding\"\nfriction = 0.05\n"
            "[load]\nduration = \"0.3 ms\"\npeak = \"200 MPa\"\npeak_time = \"0.2 ms\"\n"
            "[numerics]\ncell_size = \"2.5 mm\"\n[gap]\nthickness = \"0, 0.01 cm\"\n"
            "[output]\nsnapshots = \"0, 0.1 ms\"\nsnapshot_events = \"peak-pressure\"\n",
        "small.toml");
  });
  ASSERT_TRUE(file) << file.error().message();
  const run::CaseResult result = run::run_case(file->scene);
  write_case_file(folder() / "case.h5", {make_manifest(""), result});
  const nlohmann::json steps = read(folder() / "case.xdmf");
  const auto& snapshots = result.mechanics.snapshots;
  ASSERT_EQ(snapshots.size(), 3U);
  ASSERT_EQ(steps.size(), snapshots.size());
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    const run::Snapshot& shot = snapshots[i];
    EXPECT_DOUBLE_EQ(steps[i]["time"].get<double>(), shot.time);
    const auto& grids = steps[i]["grids"];
    ASSERT_TRUE(grids.contains("launch")) << grids.dump().substr(0, 400);
    const auto& launch = grids["launch"];
    EXPECT_EQ(launch["cells"], shot.x.size());
    EXPECT_EQ(launch["cell_types"], nlohmann::json::array({quadrilateral}));
    const std::vector<double> body = values(launch["cell_data"]["body"]);
    EXPECT_EQ(std::count(body.begin(), body.end(), 1.0), std::count(shot.body.begin(), shot.body.end(), 1));
    EXPECT_EQ(values(launch["cell_data"]["temperature"]), shot.temperature);
    EXPECT_EQ(values(launch["cell_data"]["pressure"]), shot.pressure);
  }
}

}  // namespace
}  // namespace launchsafe::store
