#include "launchsafe/store/study_record.hpp"

#include "launchsafe/version.hpp"
#include "store_fixture.hpp"

#include <fstream>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
namespace fs = std::filesystem;

class ReportFolder : public TemporaryFolder {
 protected:
  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  void write_report(const std::vector<TextFile>& files) const {
    write_report_files(folder(), {.manifest = make_manifest("a study"), .study = "study.toml"}, files);
  }
};

TEST_F(ReportFolder, HasTheFilesOfItsLastReport) {
  write_report({{"report.md", "one page"}, {"verdicts.csv", "table"}});
  write(folder() / "notes.txt", "mine");
  write_report({{"report.md", "another page"}});
  EXPECT_EQ(read_file(folder() / "report.md"), "another page");
  EXPECT_FALSE(fs::exists(folder() / "verdicts.csv"));
  EXPECT_EQ(read_file(folder() / "notes.txt"), "mine");
  const StudyRecord read = read_study_record(folder());
  EXPECT_EQ(read.files, std::vector<std::string>{"report.md"});
  EXPECT_EQ(read.study, "study.toml");
  EXPECT_EQ(read.manifest.input_text, "a study");
  EXPECT_EQ(read.manifest.input_sha256, sha256("a study"));
  EXPECT_EQ(read.manifest.program_version, version::number);
  EXPECT_EQ(read.manifest.commit, version::commit);
}

TEST_F(ReportFolder, IsEmptyOrHasOurManifest) {
  for (const char* name : {"report.md", "notes.txt", manifest_name}) {
    write(folder() / name, "mine\n");
    EXPECT_EQ(kind_of([&] { write_report({{"report.md", "page"}}); }), Error::Kind::conflict);
    EXPECT_EQ(read_file(folder() / name), "mine\n");
    fs::remove(folder() / name);
  }
}

}  // namespace
}  // namespace launchsafe::store
