// Folders with somebody else's files: nothing there is overwritten or deleted.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

namespace fs = std::filesystem;

const std::string mine = "mine: do not lose me\n";

class ForeignFiles : public StoredStudy {
 protected:
  Outcome study(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{"study", "study.toml", "-o", "out"};
    command.insert(command.end(), more.begin(), more.end());
    return run(command);
  }
  void expect_refused(const Outcome& outcome, const std::string& file) const {
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_EQ(read(file), mine);
    EXPECT_FALSE(exists("out/cases"));
  }
};

TEST_F(ForeignFiles, MakeAFolderNobodysForResults) {
  for (const std::string name : {"out/notes.txt", "out/study.db", "out/manifest.json"}) {
    SCOPED_TRACE(name);
    fs::create_directory(folder() / "out");
    write(name, mine);
    expect_refused(study(), name);
    expect_refused(study({"--update"}), name);
    expect_refused(study({"--shard", "1/2"}), name);
    expect_refused(run({"merge", "study.toml", "-o", "out"}), name);
    fs::remove_all(folder() / "out");
  }
  EXPECT_EQ(run({"study", "study.toml", "-o", "."}).code, 2) << "the folder of the study's file";
  EXPECT_FALSE(exists("cases"));
}

TEST_F(ForeignFiles, StayBesideResultsThatAreThere) {
  ASSERT_EQ(study().code, 0);
  write("out/notes.txt", mine);
  fs::remove(folder() / "out/report.md");
  EXPECT_EQ(study().code, 0);
  EXPECT_TRUE(exists("out/report.md"));
  EXPECT_EQ(read("out/notes.txt"), mine);
}

TEST_F(ForeignFiles, AreNotTakenForTheResultOfACase) {
  write("scene.toml", with(tiny_scene, "[output]", "[output]\nsnapshots = \"0.05 ms\""));
  for (const std::string name : {"out/scene.h5", "out/scene.xdmf"}) {
    fs::create_directory(folder() / "out");
    write(name, mine);
    expect_refused(run({"run", "scene.toml", "-o", "out"}), name);
    fs::remove_all(folder() / "out");
  }
}

}  // namespace
}  // namespace launchsafe::app
