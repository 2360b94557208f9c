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
  fs::path page() const { return folder() / "report.md"; }
  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  static StudyRecord record() { return {.manifest = make_manifest("a study", 1)}; }
  auto write_report(const std::vector<TextFile>& files) const {
    return write_report_files(folder(), record(), files);
  }
  auto write_page(const std::string& text) const { return write_report({{"report.md", text}}); }
  FileState state(const std::string& name) const {
    return state_of(folder(), record_of_report(folder()).value(), name);
  }
  void expect_refused(const std::string& name) const {
    const auto refused = write_report({{"new.csv", "x"}, {name, "x"}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, Error::Kind::conflict);
    EXPECT_NE(refused.error().message.find((folder() / name).string()), std::string::npos)
        << refused.error().message;
    EXPECT_FALSE(fs::exists(folder() / "new.csv"));
  }
};

TEST_F(ReportFolder, ReplacesItsOwnFilesAndNothingElse) {
  EXPECT_EQ(state("report.md"), FileState::absent);
  ASSERT_TRUE(write_page("one page"));
  EXPECT_EQ(state("report.md"), FileState::ours);
  ASSERT_TRUE(write_page("another page"));
  EXPECT_EQ(*read_file(page()), "another page");
  write(folder() / "stability.csv", "mine");
  EXPECT_EQ(state("stability.csv"), FileState::foreign);
  expect_refused("stability.csv");
  EXPECT_EQ(*read_file(folder() / "stability.csv"), "mine");
  EXPECT_TRUE(read_as_written(folder(), read_study_record(folder())->files));
}

// A folder that somebody passed on may hold a manifest with any names.
TEST_F(ReportFolder, HasNoFilesOutsideItOrOfTheStore) {
  StudyRecord claims = record();
  for (const char* name : {"../theirs.txt", "/theirs.txt", ".", "..", "", "cases", "study.db",
                           "study.1-of-2.db-journal", "manifest.json", "report.md"})
    claims.files.push_back({name, "00"});
  ASSERT_FALSE(write_study_record(folder(), claims));
  EXPECT_EQ(read_study_record(folder())->names(), std::vector<std::string>{"report.md"});
}

TEST_F(ReportFolder, FollowsNoLinks) {
  write(folder() / "theirs", "mine");
  for (const char* target : {"theirs", "nowhere"}) {
    for (const char* name : {"report.md", "manifest.json"}) {
      fs::create_symlink(folder() / target, folder() / name);
      expect_refused(name);
      fs::remove(folder() / name);
    }
  }
  EXPECT_EQ(*read_file(folder() / "theirs"), "mine");
  EXPECT_FALSE(fs::exists(folder() / "nowhere"));
  fs::create_directory(page());
  expect_refused("report.md");
}

// The manifest comes first, so a kill between leaves files as they were or as they were to be.
TEST_F(ReportFolder, MayBeWrittenAfterAKillAtAnyInstant) {
  ASSERT_TRUE(write_report({{"report.md", "page"}, {"verdicts.csv", "table"}}));
  StudyRecord unfinished = record();
  unfinished.unfinished = read_study_record(folder())->files;
  unfinished.unfinished.push_back({"report.md", sha256("page two")});
  unfinished.unfinished.push_back({"curve.svg", sha256("curve")});
  ASSERT_FALSE(write_study_record(folder(), unfinished));
  for (const char* text : {"page", "page two"}) {
    write(page(), text);
    EXPECT_EQ(state("report.md"), FileState::ours);
  }
  const auto remarks = write_report({{"report.md", "page two"}, {"curve.svg", "curve"}});
  ASSERT_TRUE(remarks) << remarks.error().message;
  EXPECT_EQ(remarks->size(), 1U) << "the table moved";
  EXPECT_EQ(*read_file(folder() / "earlier-1" / "verdicts.csv"), "table");
  EXPECT_EQ(state("verdicts.csv"), FileState::absent);
}

TEST_F(ReportFolder, TakesAFileOfTheSameContentWhoeverWroteIt) {
  write(page(), "page");
  EXPECT_TRUE(write_page("page"));
}

TEST_F(ReportFolder, NeedsAManifestThatIsOurs) {
  write(folder() / manifest_name, "mine\n");
  EXPECT_FALSE(write_page("text"));
  EXPECT_EQ(*read_file(folder() / manifest_name), "mine\n");
  EXPECT_FALSE(fs::exists(page()));
}

TEST_F(ReportFolder, KeepsEditedFilesUnderAnotherName) {
  ASSERT_TRUE(write_report({{"report.md", "page"}, {"verdicts.csv", "table"}}));
  write(page(), "page with notes");
  EXPECT_EQ(state("report.md"), FileState::edited);
  write(folder() / "report.md.edited-1", "older notes");
  const auto remarks = write_report({{"report.md", "page"}, {"verdicts.csv", "table"}});
  ASSERT_TRUE(remarks) << remarks.error().message;
  EXPECT_EQ(remarks->size(), 1U);
  EXPECT_EQ(*read_file(folder() / "report.md.edited-1"), "older notes");
  EXPECT_EQ(*read_file(folder() / "report.md.edited-2"), "page with notes");
  EXPECT_EQ(*read_file(page()), "page");
}

TEST_F(ReportFolder, OfACaseIsNotWrittenOverSomebodyElsesFile) {
  write(folder() / "case.xdmf", "mine");
  for (int attempt = 0; attempt < 2; ++attempt) {
    const MaybeError error =
        write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest());
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind, Error::Kind::conflict);
    EXPECT_EQ(*read_file(folder() / "case.xdmf"), "mine");
  }
  fs::remove(folder() / "case.xdmf");
  for (int attempt = 0; attempt < 2; ++attempt)
    EXPECT_FALSE(write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest()));
}

TEST(TemporaryName, IsOneOnlyIfWeMadeIt) {
  for (const char* name : {"report.md", "a", ".hidden", "two words", "x.partial"})
    EXPECT_EQ(name_behind(temporary_name(name)), name);
  EXPECT_NE(temporary_name("a"), temporary_name("a"));
  for (const char* name : {".x.partial", ".report.md.0123456789abcdef.partial", "report.md", ".partial", "",
                           "..0123456789abcdef.partial", ".a.00000000.partial"})
    EXPECT_FALSE(name_behind(name)) << name;
}

}  // namespace
}  // namespace launchsafe::store
