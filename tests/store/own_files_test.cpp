#include "launchsafe/store/own_files.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "sample_case.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
namespace fs = std::filesystem;

class OwnFile : public TemporaryFolder {
 protected:
  fs::path page() const { return folder() / "report.md"; }
  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  FileState state(const std::string& name) const { return OwnFiles::read(folder())->state_of(name); }
};

TEST_F(OwnFile, IsReplacedAndNothingElseIs) {
  EXPECT_EQ(state("report.md"), FileState::absent);
  ASSERT_FALSE(write_own_file(page(), "one page"));
  EXPECT_EQ(state("report.md"), FileState::ours);
  ASSERT_FALSE(write_own_file(page(), "another page"));
  EXPECT_EQ(*read_file(page()), "another page");

  write(page(), "another page, and a note of mine");
  EXPECT_EQ(state("report.md"), FileState::edited);
  for (const MaybeError& error : {write_own_file(page(), "a third"), obstacle_to_own_file(page())}) {
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind, Error::Kind::conflict);
    EXPECT_NE(error->message.find(page().string()), std::string::npos) << error->message;
  }
  EXPECT_EQ(*read_file(page()), "another page, and a note of mine");

  write(folder() / "stability.csv", "mine");
  EXPECT_EQ(state("stability.csv"), FileState::foreign);
  EXPECT_TRUE(write_own_file(folder() / "stability.csv", "x"));
  EXPECT_EQ(*read_file(folder() / "stability.csv"), "mine");
}

// A folder that somebody passed on may hold a journal with any names.
TEST_F(OwnFile, IsNeverOneOutsideTheFolderOrOfTheStore) {
  ASSERT_FALSE(write_own_file(page(), "text"));
  const fs::path theirs = folder().parent_path() / "theirs.txt";
  const std::string journal = (folder() / own_files_name).string();
  for (const std::string& name :
       {theirs.string(), std::string("../theirs.txt"), std::string("."), std::string(".."),
        std::string("cases"), std::string("study.db"), std::string("study.1-of-2.db-journal")})
    std::ofstream(journal, std::ios::app) << R"({"file":")" << name << R"(","sha256":"00"})"
                                          << "\n";
  const auto own = OwnFiles::read(folder());
  ASSERT_TRUE(own);
  EXPECT_EQ(own->present(), std::vector<std::string>{"report.md"});
}

TEST_F(OwnFile, ThatIsALinkOrAFolderIsNone) {
  write(folder() / "theirs", "mine");
  fs::create_symlink(folder() / "theirs", page());
  EXPECT_TRUE(write_own_file(page(), "text"));
  EXPECT_EQ(*read_file(folder() / "theirs"), "mine");
  fs::remove(page());
  fs::create_symlink(folder() / "nowhere", page());
  EXPECT_TRUE(write_own_file(page(), "text"));
  EXPECT_FALSE(fs::exists(folder() / "nowhere"));
  fs::remove(page());
  fs::create_directory(page());
  EXPECT_TRUE(write_own_file(page(), "text"));
  EXPECT_TRUE(fs::is_directory(page()));
}

// The journal's line comes first, so a kill between the two leaves a name that is known and not there.
TEST_F(OwnFile, MayBeWrittenAfterAKillAtAnyInstant) {
  ASSERT_FALSE(note_own_files(folder(), {{"report.md", sha256("page")}}));
  ASSERT_FALSE(write_own_file(page(), "page"));
  write(folder() / own_files_name, *read_file(folder() / own_files_name) + "{\"file\":\"verdic");
  EXPECT_EQ(state("report.md"), FileState::ours);
  ASSERT_FALSE(write_own_file(page(), "page two"));
  EXPECT_EQ(state("report.md"), FileState::ours);
}

TEST_F(OwnFile, OfTheSameContentStays) {
  write(page(), "page");
  EXPECT_FALSE(write_own_file(page(), "page")) << "whoever wrote it";
  EXPECT_FALSE(fs::exists(folder() / own_files_name));
}

TEST_F(OwnFile, NeedsAJournalOfFilesThatIsOurs) {
  write(folder() / own_files_name, "mine\n");
  const MaybeError error = write_own_file(page(), "text");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(folder() / own_files_name), "mine\n");
  EXPECT_FALSE(fs::exists(page()));
  fs::remove(folder() / own_files_name);
  write(folder() / "theirs", "");
  fs::create_symlink(folder() / "theirs", folder() / own_files_name);
  EXPECT_TRUE(write_own_file(page(), "text"));
  EXPECT_EQ(*read_file(folder() / "theirs"), "");
}

TEST_F(OwnFile, EditedIsKeptUnderAnotherName) {
  ASSERT_FALSE(write_own_file(page(), "page"));
  ASSERT_FALSE(write_own_file(folder() / "verdicts.csv", "table"));
  write(page(), "page with notes");
  write(folder() / "report.md.edited-1", "older notes");
  const auto moved = set_edited_aside(folder());
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(*moved, std::vector<std::string>{"report.md.edited-2"});
  EXPECT_EQ(*read_file(folder() / "report.md.edited-1"), "older notes");
  EXPECT_EQ(*read_file(folder() / "report.md.edited-2"), "page with notes");
  EXPECT_FALSE(fs::exists(page()));
  EXPECT_EQ(*read_file(folder() / "verdicts.csv"), "table");
}

TEST_F(OwnFile, ACaseFileProvesItself) {
  ASSERT_FALSE(write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest()));
  EXPECT_EQ(state("case.h5"), FileState::ours);
  write(folder() / "case.h5", "no case");
  EXPECT_EQ(state("case.h5"), FileState::foreign);
}

TEST_F(OwnFile, BesideACaseIsNotWrittenOverSomebodyElses) {
  write(folder() / "case.xdmf", "mine");
  const MaybeError error =
      write_case_file(folder() / "case.h5", sample_scene(), sample_case(), sample_manifest());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(folder() / "case.xdmf"), "mine");
}

TEST_F(OwnFile, NameIsTemporaryOnlyIfWeMadeIt) {
  for (const char* name : {"report.md", "a", ".hidden", "two words", "x.partial"})
    EXPECT_EQ(name_behind(temporary_name(name)), name);
  EXPECT_NE(temporary_name("a"), temporary_name("a"));
  for (const char* name : {".x.partial", ".report.md.0123456789abcdef.partial", "report.md", ".partial", "",
                           "..0123456789abcdef.partial", ".a.00000000.partial"})
    EXPECT_FALSE(name_behind(name)) << name;
}

}  // namespace
}  // namespace launchsafe::store
