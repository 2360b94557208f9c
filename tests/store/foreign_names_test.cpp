// A store in a folder where somebody else's files have the names that it needs: nothing is changed.
#include "launchsafe/store/file.hpp"
#include "store_fixture.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <map>

namespace launchsafe::store {
namespace {

using namespace launchsafe::testing;
namespace fs = std::filesystem;

class ForeignNames : public StoreFixture {
 protected:
  fs::path theirs() const { return folder() / "theirs.txt"; }

  void SetUp() override {
    StoreFixture::SetUp();
    fs::create_directory(where());
    write(theirs(), "mine\n");
  }

  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }

  /// A database as another program, or another version of this one, makes it.
  static void make_database(const fs::path& path, int application, int version) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    const std::string statements = fmt::format(
        "PRAGMA application_id = {}; PRAGMA user_version = {}; CREATE TABLE t (x)", application, version);
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }

  /// Everything below a folder: its kind, and the content of regular files and links.
  static std::map<std::string, std::string> tree(const fs::path& folder) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::file_status status = entry.symlink_status();
      std::string what = std::to_string(static_cast<int>(status.type()));
      if (fs::is_symlink(status)) what += fs::read_symlink(entry.path()).string();
      if (fs::is_regular_file(status)) what += *read_file(entry.path());
      found[fs::relative(entry.path(), folder).string()] = what;
    }
    return found;
  }

  void expect_refused(const std::string& name, const std::string& how, const std::string& part) const {
    SCOPED_TRACE(name + ": " + how);
    const auto before = tree(folder());
    const auto store = try_open(where(), part);
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().kind, Error::Kind::conflict) << store.error().message;
    EXPECT_NE(store.error().message.find((where() / name).string()), std::string::npos)
        << store.error().message;
    EXPECT_EQ(tree(folder()), before);
  }
};

/// A store makes its folder of cases first, so that an empty results file beside none is somebody else's.
TEST_F(ForeignNames, MayBeThoseOfEmptyFiles) {
  for (const std::string name : {"study.db", "status.json"}) {
    write(where() / name, "");
    expect_refused(name, "an empty file", "");
    fs::remove(where() / name);
  }
}

TEST_F(ForeignNames, MayBeThoseOfCases) {
  fs::create_directories(where() / "cases");
  const std::string name = "cases/" + std::string(32, 'a') + ".h5";
  const fs::path taken = where() / name;
  fs::create_symlink(theirs(), taken);
  expect_refused(name, "a link", "");
  fs::remove(taken);
  fs::create_directory(taken);
  expect_refused(name, "a folder", "");
}

TEST_F(ForeignNames, AreRefusedAndLeftAsTheyAre) {
  const std::map<std::string, std::function<void(const fs::path&)>> ways{
      {"text", [](const fs::path& path) { write(path, "do not lose me\n"); }},
      {"JSON", [](const fs::path& path) { write(path, "{\"format\":\"mine\"}"); }},
      {"a database of another program", [](const fs::path& path) { make_database(path, 7, 1); }},
      {"a link to a file", [&](const fs::path& path) { fs::create_symlink(theirs(), path); }},
      {"a link to nowhere", [&](const fs::path& path) { fs::create_symlink(folder() / "gone", path); }},
      {"a second name of a file", [&](const fs::path& path) { fs::create_hard_link(theirs(), path); }},
      {"a folder", [](const fs::path& path) { fs::create_directory(path); }},
      {"a pipe", [](const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); }},
  };
  for (const std::string part : {"", "1-of-2"}) {
    const std::string dotted = part.empty() ? "" : "." + part;
    for (const std::string& name :
         {"study" + dotted + ".db", "study" + dotted + ".db-journal", "status" + dotted + ".json"}) {
      for (const auto& [how, make] : ways) {
        make(where() / name);
        expect_refused(name, how, part);
        fs::remove_all(where() / name);
      }
    }
  }
}

TEST_F(ForeignNames, AFolderOfCasesHasToBeOne) {
  fs::create_directory(folder() / "disk");
  fs::create_directory_symlink(folder() / "disk", where() / "cases");
  expect_refused("cases", "a link", "");
  fs::remove(where() / "cases");
  write(where() / "cases", "mine");
  expect_refused("cases", "a file", "");
}

// A file of another name than the store needs is nobody's business here.
TEST_F(ForeignNames, OtherFilesDoNotMatter) {
  for (const char* name : {"study.toml", "journal", "status.txt", "study.db.bak"})
    write(where() / name, "mine");
  ASSERT_TRUE(opened());
  for (const char* name : {"study.toml", "journal", "status.txt", "study.db.bak"})
    EXPECT_EQ(*read_file(where() / name), "mine");
}

TEST_F(ForeignNames, WhatAKillLeftOfOurOwnIsUsedAgain) {
  fs::create_directory(where() / "cases");
  for (const char* name : {"study.db", "study.db-journal"}) write(where() / name, "");
  EXPECT_TRUE(try_open(where()));
  write(where() / "study.db-journal", std::string(512, '\0'));
  EXPECT_TRUE(try_open(where()));
}

TEST_F(ForeignNames, AResultsFileOfAnotherFormatIsRefusedWithWhatToDo) {
  make_database(results(), 0x4c534146, 1);
  const auto store = try_open(where());
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().message.find("format 1"), std::string::npos) << store.error().message;
  EXPECT_NE(store.error().message.find("run the study anew"), std::string::npos) << store.error().message;
}

TEST_F(ForeignNames, ADamagedResultsFileIsRefusedAndStaysAsItIs) {
  fill(20);
  std::string bytes = *read_file(results());
  for (std::size_t i = 4096; i < bytes.size(); i += 64) bytes[i] = 'x';
  write(results(), bytes);
  for (const auto& store : {try_open(where()), CaseStore::open_to_read(where())}) {
    ASSERT_FALSE(store);
    EXPECT_EQ(store.error().kind, Error::Kind::corrupt);
    EXPECT_NE(store.error().message.find("move it away"), std::string::npos) << store.error().message;
  }
  EXPECT_TRUE(*read_file(results()) == bytes);
  fs::remove(results());
  const auto store = opened();
  for (int number = 0; number < 20; ++number) EXPECT_TRUE(store->holds(identity_of(number).hash()));
}

TEST_F(ForeignNames, LeftoversAreOnlyThoseThatWeMade) {
  opened();
  const fs::path cases = where() / "cases";
  const std::string hash = identity_of(1).hash();
  const std::string ours = temporary_name(hash + ".whole");
  write(cases / ours, "half");
  std::string altered = ours;
  altered[altered.size() - 10] = altered[altered.size() - 10] == '0' ? '1' : '0';
  for (const std::string& name :
       {std::string(".x.partial"), "." + hash + ".whole-0123456789abcdef-0.partial", altered,
        "." + hash + ".whole.0123456789abcdef.partial", temporary_name("notes.whole")})
    write(cases / name, "mine");
  fs::create_directory(cases / temporary_name(hash + ".whole"));
  fs::create_symlink(theirs(), cases / temporary_name(hash + ".whole"));
  auto before = tree(cases);
  opened();
  EXPECT_EQ(before.erase(ours), 1U);
  EXPECT_EQ(tree(cases), before);
}

TEST_F(ForeignNames, AFileInTheWayOfACaseIsKept) {
  const auto store = opened();
  const fs::path target = file_of(3);
  write(target, "mine, and no case");
  save(*store, 3);
  const MaybeError error = store->flush();
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::write_failed);
  EXPECT_EQ(*read_file(target), "mine, and no case");
}

}  // namespace
}  // namespace launchsafe::store
