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
                           "histories_0.01cm.svg", "profile.svg", "air.svg", "energy.svg"}) {
    EXPECT_TRUE(read(std::string("shell_pictures/") + name).starts_with("<?xml")) << name;
    EXPECT_NE(outcome.out.find(std::string("shell_pictures/") + name + "\n"), std::string::npos) << name;
  }
  EXPECT_TRUE(outcome.says("no picture of combustion: ")) << outcome.err;
  EXPECT_EQ(run({"plot", "shell.h5"}).code, 0) << "they are there already";
}

TEST_F(Plotted, ListsWhatItWroteAsJson) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome =
      run({"plot", "shell.h5", "-o", "out", "--what", "fields, air", "--times", "0.02 ms", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["folder"], "out");
  ASSERT_EQ(object["pictures"].size(), 4U) << "three fields at one time, and the air: cracks do not grow";
  for (const auto& picture : object["pictures"]) EXPECT_TRUE(exists(picture["file"])) << picture;
  EXPECT_EQ(object["pictures"][0]["what"], "fields");
  EXPECT_NEAR(object["pictures"][0]["time_ms"].get<double>(), 0.02, 0.002);
  EXPECT_EQ(object["pictures"][3]["file"], "out/air.svg");
  EXPECT_TRUE(object["left_out"].empty());
  const auto all = nlohmann::json::parse(run({"plot", "shell.h5", "-o", "all", "--json"}).out);
  ASSERT_EQ(all["left_out"].size(), 1U);
  EXPECT_EQ(all["left_out"][0]["what"], "combustion");
}

TEST_F(Plotted, DrawsWhatWasPublishedOfTheGapThatItWasPublishedOf) {
  write("published.toml", "reference = [{ gap = \"0.01 cm\", maximum_temperature = \"310 K\" }]\n");
  expect_refused({"shell.h5", "-o", "out", "--references", "none.toml"}, "none.toml");
  EXPECT_EQ(
      run({"plot", "shell.h5", "-o", "out", "--references", "none.toml"}).err.find("study file's folder"),
      std::string::npos);
  expect_refused({"shell.h5", "-o", "out", "--references", "shell.toml"}, "another kind of file");
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome =
      run({"plot", "shell.h5", "-o", "out", "--what", "histories", "--references", "published.toml"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(read("out/histories_0.01cm.svg").find("published"), std::string::npos);
  EXPECT_EQ(read("out/histories_0cm.svg").find("published"), std::string::npos);
}

TEST_F(Plotted, OverwritesNothing) {
  if (!can_draw()) GTEST_SKIP() << "gnuplot is not installed";
  std::filesystem::create_directory(folder() / "mine");
  write("mine/pressure.svg", "mine");
  const Outcome outcome = run({"plot", "shell.h5", "-o", "mine"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("mine/pressure.svg is there with another content")) << outcome.err;
  EXPECT_EQ(read("mine/pressure.svg"), "mine");
  EXPECT_FALSE(exists("mine/air.svg")) << "all or none";
}

TEST_F(Plotted, RefusesWhatIsNoCase) {
  write("notes.h5", "somebody's notes");
  const hid_t file = H5Fcreate((folder() / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  H5Fclose(file);
  const std::string whole = read("shell.h5");
  write("half.h5", whole.substr(0, whole.size() / 2));
  expect_refused({"notes.h5", "-o", "out"}, "notes.h5: not a launchsafe case file; allowed: a case file");
  expect_refused({"other.h5", "-o", "out"}, "other.h5: not a launchsafe case file; allowed: a case file");
  expect_refused({"half.h5", "-o", "out"}, "half.h5: truncated");
  expect_refused({"none.h5", "-o", "out"}, "none.h5");
  expect_refused({"shell.toml", "-o", "out"}, "shell.toml: not a launchsafe case file");
  expect_refused({".", "-o", "out"}, "found a folder; allowed: a case file");
  expect_refused({".", "-o", "out"}, "did you mean \"./half.h5\"");
  std::filesystem::create_directories(folder() / "study/cases");
  write("study/cases/one.h5", whole);
  expect_refused({"study", "-o", "out"}, "did you mean \"study/cases/one.h5\"?");
}

TEST_F(Plotted, RefusesWordsAndTimesThatItDoesNotKnow) {
  expect_refused({"shell.h5", "-o", "out", "--what", "presure"}, "did you mean pressure?");
  expect_refused({"shell.h5", "-o", "out", "--what", "pressure,nonsense"}, "\"nonsense\"");
  expect_refused({"shell.h5", "-o", "out", "--what", ","}, "--what");
  expect_refused({"shell.h5", "-o", "out", "--what", "combustion"}, "no gap of it ignited");
  expect_refused({"shell.h5", "-o", "out", "--times", "0.03 ms"}, "no snapshot; allowed: 20 µs, 50 µs");
  expect_refused({"shell.h5", "-o", "out", "--times", "0.02"}, "--times");
  expect_refused({"shell.h5", "-o", "out", "--times", "0.02 K"}, "--times");
  expect_refused({"shell.h5", "-o", "out", "--what", "profile", "--times", "1 ms"},
                 "until the end of the run");
  expect_refused({"shell.h5", "-o", "out", "--what", "air", "--times", "0.02 ms"},
                 "where fields or profile are drawn");
}

TEST_F(Plotted, SaysWhatDrawsWhereThatIsNotInstalled) {
  before_start([] { ::setenv("PATH", "/nowhere", 1); });
  expect_refused({"shell.h5", "-o", "out"}, "found no program gnuplot");
}

TEST_F(Plotted, WritesNumbersAsTablesWithoutGnuplot) {
  before_start([] { ::setenv("PATH", "/nowhere", 1); });
  expect_refused({"shell.h5", "-o", "out", "--csv", "--what", "air"},
                 "which --csv has no data for: there are pictures of it alone");
  const Outcome outcome = run({"plot", "shell.h5", "-o", "out", "--csv"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "out/pressure.csv\nout/field_0.02ms.csv\nout/field_0.05ms.csv\nout/histories_0cm.csv\n"
            "out/histories_0.01cm.csv\n");
  EXPECT_TRUE(outcome.says("no table of air: ")) << outcome.err;
  EXPECT_TRUE(read("out/pressure.csv").starts_with("time_ms,chamber_MPa,bottom_MPa\r\n0,"));
  const auto object = nlohmann::json::parse(
      run({"plot", "shell.h5", "-o", "out", "--csv", "--json", "--what", "pressure"}).out);
  EXPECT_EQ(object["tables"][0]["file"], "out/pressure.csv");
}

}  // namespace
}  // namespace launchsafe::app
