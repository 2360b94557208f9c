// launchsafe plot: what it writes, and what it refuses.
#include "launchsafe/store/case_file.hpp"
#include "program.hpp"
#include "report/gnuplot.hpp"

#include <hdf5.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace launchsafe::app {
namespace {

class Plotted : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", with(tiny_scene, "[output]\n", "[output]\nsnapshots = \"0.02, 0.05 ms\"\n"));
    const Outcome outcome = run({"run", "shell.toml", "-o", "."});
    ASSERT_TRUE(exists("shell.h5")) << outcome.err;
  }

  /// Tests that draw are skipped, and say so, where gnuplot is not installed.
  static bool can_draw() { return report::gnuplot_is_there(); }

  void expect_refused(const std::vector<std::string>& arguments, const std::string& part) {
    std::vector<std::string> all{"plot"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.code, 2) << part << outcome.err;
    EXPECT_TRUE(outcome.says(part)) << part << " in " << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_FALSE(exists("out")) << part;
  }
};

TEST_F(Plotted, WritesAllThatTheCaseHasDataForBesideIt) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = run({"plot", "shell.h5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"pressure.svg", "field_temperature_0.02ms.svg", "field_von_mises_0.05ms.svg",
                           "histories_0.01cm.svg", "profile.svg"}) {
    EXPECT_TRUE(read(std::string("shell_pictures/") + name).starts_with("<?xml")) << name;
    EXPECT_NE(outcome.out.find(std::string("shell_pictures/") + name + "\n"), std::string::npos) << name;
  }
  EXPECT_EQ(run({"plot", "shell.h5"}).code, 0) << "they are there already";
}

TEST_F(Plotted, ListsWhatItWroteAsJson) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome =
      run({"plot", "shell.h5", "-o", "out", "--what", "fields,profile", "--times", "0.02 ms", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["folder"], "out");
  ASSERT_EQ(object["pictures"].size(), 4U) << "three fields at one time, and the profile: cracks do not grow";
  for (const auto& picture : object["pictures"]) EXPECT_TRUE(exists(picture["file"])) << picture;
  EXPECT_EQ(object["pictures"][0]["what"], "fields");
  EXPECT_NEAR(object["pictures"][0]["time_ms"].get<double>(), 0.02, 0.002);
  EXPECT_EQ(object["pictures"][3]["file"], "out/profile_0.02ms.svg");
}

TEST_F(Plotted, OverwritesNothing) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  std::filesystem::create_directory(folder() / "mine");
  write("mine/pressure.svg", "mine");
  const Outcome outcome = run({"plot", "shell.h5", "-o", "mine"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("mine/pressure.svg")) << outcome.err;
  EXPECT_EQ(read("mine/pressure.svg"), "mine");
  EXPECT_FALSE(exists("mine/profile.svg")) << "all or none";
}

TEST_F(Plotted, RefusesWhatIsNoCase) {
  write("notes.h5", "somebody's notes");
  const hid_t file = H5Fcreate((folder() / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  H5Fclose(file);
  const std::string whole = read("shell.h5");
  write("half.h5", whole.substr(0, whole.size() / 2));
  expect_refused({"notes.h5", "-o", "out"}, "notes.h5");
  expect_refused({"other.h5", "-o", "out"}, "other.h5");
  expect_refused({"half.h5", "-o", "out"}, "half.h5");
  expect_refused({"none.h5", "-o", "out"}, "none.h5");
  expect_refused({"shell.toml", "-o", "out"}, "shell.toml");
}

TEST_F(Plotted, WritesNumbersAsTablesWithoutGnuplot) {
  before_start([] { ::setenv("PATH", "/nowhere", 1); });
  const Outcome outcome = run({"plot", "shell.h5", "-o", "out", "--csv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "out/pressure.csv\nout/field_0.02ms.csv\nout/field_0.05ms.csv\nout/histories_0cm.csv\n"
            "out/histories_0.01cm.csv\n");
  EXPECT_TRUE(read("out/pressure.csv").starts_with("time_ms,chamber_MPa,bottom_MPa\r\n0,"));
  const auto object = nlohmann::json::parse(
      run({"plot", "shell.h5", "-o", "out", "--csv", "--json", "--what", "pressure"}).out);
  EXPECT_EQ(object["tables"][0]["file"], "out/pressure.csv");
}

}  // namespace
}  // namespace launchsafe::app
