#include "launchsafe/store/study_record.hpp"

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/file.hpp"
#include "sample_case.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

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
  static StudyRecord record() { return {.manifest = make_manifest("a study", 1)}; }
  MaybeError write_report(const std::vector<TextFile>& files) const {
    return write_report_files(folder(), record(), files);
  }
};

TEST_F(ReportFolder, HasTheFilesOfItsLastReport) {
  ASSERT_FALSE(write_report({{"report.md", "one page"}, {"verdicts.csv", "table"}}));
  write(folder() / "notes.txt", "mine");
  ASSERT_FALSE(write_report({{"report.md", "another page"}}));
  EXPECT_EQ(*read_file(folder() / "report.md"), "another page");
  EXPECT_FALSE(fs::exists(folder() / "verdicts.csv"));
  EXPECT_EQ(*read_file(folder() / "notes.txt"), "mine");
  const auto read = read_study_record(folder());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->files, std::vector<std::string>{"report.md"});
  EXPECT_EQ(read->manifest.input_text, "a study");
}

TEST_F(ReportFolder, IsEmptyOrHasOurManifest) {
  for (const char* name : {"report.md", "notes.txt", manifest_name}) {
    write(folder() / name, "mine\n");
    const MaybeError refused = write_report({{"report.md", "page"}});
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->kind, Error::Kind::conflict);
    EXPECT_NE(refused->message.find(name), std::string::npos) << refused->message;
    EXPECT_EQ(*read_file(folder() / name), "mine\n");
    fs::remove(folder() / name);
  }
}

TEST_F(ReportFolder, MovesAReportAsideWithItsManifest) {
  ASSERT_FALSE(write_report({{"report.md", "page"}}));
  fs::create_directory(folder() / "earlier-1");
  const auto moved = set_aside(folder(), *read_study_record(folder()));
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(*moved, folder() / "earlier-2");
  EXPECT_EQ(*read_file(*moved / "report.md"), "page");
  EXPECT_TRUE(read_study_record(*moved));
  EXPECT_FALSE(fs::exists(folder() / "report.md"));
}

TEST_F(ReportFolder, OfACaseIsNotWrittenOverSomebodyElsesFile) {
  write(folder() / "case.xdmf", "mine");
  const MaybeError error =
      write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(folder() / "case.xdmf"), "mine");
  fs::remove(folder() / "case.xdmf");
  for (int attempt = 0; attempt < 2; ++attempt)
    EXPECT_FALSE(write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest()));
}

}  // namespace
}  // namespace launchsafe::store
