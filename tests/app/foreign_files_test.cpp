// Somebody else's files, under every name that the program gives a file of its own, and its own files after
// somebody edited them: nothing is overwritten, emptied, appended to or deleted.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

namespace fs = std::filesystem;

const std::string mine = "mine: do not lose me\n";

struct Target {
  std::string name;                  ///< of the test
  std::vector<std::string> command;  ///< writes into `out`
  std::vector<std::string> files;    ///< names that the command gives its files
};

/// One of every command; what studies of other kinds write is asked of kinds_battery_test.cpp.
std::vector<Target> targets() {
  return {
      {"Sweep",
       {"study", "study.toml", "-o", "out"},
       {"study.db", "status.json", "cases", "manifest.json", "report.md", "study.json", "verdicts.csv",
        "critical_gaps.csv", "critical_gap.svg", "critical_gap_2.svg"}},
      {"Shard",
       {"study", "study.toml", "-o", "out", "--shard", "1/2"},
       {"study.1-of-2.db", "status.1-of-2.json", "manifest.json"}},
      {"Merge", {"merge", "study.toml", "-o", "out"}, {"study.db", "manifest.json", "report.md"}},
      {"Run", {"run", "scene.toml", "-o", "out"}, {"scene.h5", "scene.xdmf"}},
  };
}

class ForeignFiles : public StoredStudy, public ::testing::WithParamInterface<Target> {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    write("scene.toml", with(tiny_scene, "[output]", "[output]\nsnapshots = \"0.05 ms\""));
    write("theirs.txt", mine);
  }

  /// Whether the program refused, naming the file, and the folder holds what it held before.
  void expect_refused(const std::string& name) {
    const auto before = results_and_all("out");
    const Outcome outcome = run(GetParam().command);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(outcome.says(fs::path(name).filename().string())) << outcome.err;
    EXPECT_EQ(results_and_all("out"), before);
    EXPECT_EQ(read("theirs.txt"), mine);
  }

  /// The names of all that is below a folder, with the contents of regular files.
  std::map<std::string, std::string> results_and_all(const std::string& name) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder() / name)) {
      const std::string file = fs::relative(entry.path(), folder() / name).string();
      found[file] = entry.is_symlink()        ? "-> " + fs::read_symlink(entry.path()).string()
                    : entry.is_regular_file() ? read(name + "/" + file)
                                              : "no regular file";
    }
    return found;
  }
};

TEST_P(ForeignFiles, KeepTheirContent) {
  for (const std::string& name : GetParam().files) {
    SCOPED_TRACE(name);
    fs::create_directories((folder() / "out" / name).parent_path());
    write("out/" + name, mine);
    expect_refused(name);
    fs::remove_all(folder() / "out");
  }
}

TEST_P(ForeignFiles, ThatAreLinksAreNotFollowed) {
  for (const std::string& name : GetParam().files) {
    for (const char* target : {"theirs.txt", "nowhere.txt"}) {
      SCOPED_TRACE(name + " to " + target);
      fs::create_directories((folder() / "out" / name).parent_path());
      fs::create_symlink(folder() / target, folder() / "out" / name);
      expect_refused(name);
      EXPECT_FALSE(exists("nowhere.txt"));
      fs::remove_all(folder() / "out");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Names, ForeignFiles, ::testing::ValuesIn(targets()),
                         [](const auto& test) { return test.param.name; });

class OwnFolder : public StoredStudy {
 protected:
  Outcome study() { return run({"study", "study.toml", "-o", "out"}); }
};

TEST_F(OwnFolder, EditedReportsAreKeptUnderAnotherName) {
  ASSERT_EQ(study().code, 0);
  const std::string page = read("out/report.md");
  write("out/report.md", page + mine);
  write("out/critical_gaps.csv", mine);
  const Outcome again = study();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(again.says("out/report.md.edited-1")) << again.err;
  EXPECT_EQ(read("out/report.md.edited-1"), page + mine);
  EXPECT_EQ(read("out/critical_gaps.csv.edited-1"), mine);
  EXPECT_EQ(read("out/report.md"), page);
}

TEST_F(OwnFolder, WithoutItsManifestIsNobodys) {
  ASSERT_EQ(study().code, 0);
  const auto whole = results_in("out");
  fs::remove(folder() / "out/manifest.json");
  EXPECT_EQ(run({"study", "study.toml", "-o", "out", "--update"}).code, 2);
  EXPECT_EQ(results_in("out"), whole);
}

TEST_F(OwnFolder, EarlierReportsGoWhereNobodyElsesFilesAre) {
  ASSERT_EQ(study().code, 0);
  const std::string page = read("out/report.md");
  fs::create_directory(folder() / "out/earlier-1");
  write("out/earlier-1/report.md", mine);
  write("out/earlier-1/notes.txt", mine);
  fs::create_symlink(folder(), folder() / "out/earlier-2");
  write("study.toml", with(sweep_study, "20, 40 us", "20, 60 us"));
  const Outcome updated = run({"study", "study.toml", "-o", "out", "--update"});
  EXPECT_EQ(updated.code, 0) << updated.err;
  EXPECT_EQ(read("out/earlier-1/report.md"), mine);
  EXPECT_FALSE(exists("report.md"));
  EXPECT_EQ(read("out/earlier-3/report.md"), page);
  EXPECT_TRUE(exists("out/earlier-3/manifest.json"));
}

TEST_F(OwnFolder, FilesThatANewReportLacksMoveAside) {
  write("study.toml", sweep_study.substr(0, sweep_study.find("[[vary]]")));  // one case, drawn whatever it is
  study();
  const std::string picture = read("out/temperature.svg");
  if (picture.empty()) GTEST_SKIP() << "no gnuplot";
  // Found nowhere, so that the report has no picture; a page that is gone makes it be written again.
  fs::remove(folder() / "out/report.md");
  before_start([] { ::setenv("PATH", "/nowhere", 1); });
  study();
  EXPECT_TRUE(exists("out/report.md"));
  EXPECT_FALSE(exists("out/temperature.svg")) << "it is not of this report";
  EXPECT_EQ(read("out/earlier-1/temperature.svg"), picture);
}

TEST_F(OwnFolder, MayBeALink) {
  fs::create_directory(folder() / "disk");
  fs::create_directory_symlink(folder() / "disk", folder() / "out");
  EXPECT_EQ(study().code, 0);
  EXPECT_TRUE(exists("disk/report.md"));
  EXPECT_EQ(study().code, 0);
}

}  // namespace
}  // namespace launchsafe::app
