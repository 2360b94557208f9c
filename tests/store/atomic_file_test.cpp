#include "child_process.hpp"
#include "launchsafe/store/file.hpp"
#include "temporary_folder.hpp"

#include <sys/stat.h>

namespace launchsafe::store {
namespace {

using AtomicFile = launchsafe::testing::TemporaryFolder;
using Names = std::vector<std::string>;

TEST_F(AtomicFile, HoldsThePartsOneAfterTheOther) {
  const auto path = folder() / "result";
  ASSERT_FALSE(write_file_atomically(path, std::string_view("first \0second", 13), IfExists::replace));
  const Result<std::string> content = read_file(path);
  ASSERT_TRUE(content);
  EXPECT_EQ(*content, std::string("first \0second", 13));
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(AtomicFile, ReplacesOnlyWhenAskedTo) {
  const auto path = folder() / "result";
  ASSERT_FALSE(write_file_atomically(path, "old", IfExists::replace));
  const MaybeError refused = write_file_atomically(path, "new", IfExists::refuse);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, Error::Kind::conflict);
  EXPECT_EQ(*read_file(path), "old");
  EXPECT_FALSE(write_file_atomically(path, "new", IfExists::replace));
  EXPECT_EQ(*read_file(path), "new");
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(AtomicFile, WritesBesideTheProgramWhenThePathHasNoFolder) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder());
  EXPECT_FALSE(write_file_atomically("result", "content", IfExists::replace));
  std::filesystem::current_path(before);
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(AtomicFile, IsAsReadableAsAnyFileOfTheUser) {
  ASSERT_FALSE(write_file_atomically(folder() / "result", "content", IfExists::replace));
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat((folder() / "result").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0666 & ~mask);
}

TEST_F(AtomicFile, AFullDiskLeavesNothingBehind) {
  const auto path = folder() / "result";
  const std::string large(100'000, 'x');
  EXPECT_TRUE(launchsafe::testing::holds_under_file_size_limit(65'536, [&] {
    const MaybeError error = write_file_atomically(path, large, IfExists::replace);
    return error && error->kind == Error::Kind::write_failed;
  }));
  EXPECT_EQ(listing(), Names{});
}

TEST_F(AtomicFile, AFullDiskLeavesTheOldFileAsItWas) {
  const auto path = folder() / "result";
  ASSERT_FALSE(write_file_atomically(path, "old", IfExists::replace));
  const std::string large(100'000, 'x');
  EXPECT_TRUE(launchsafe::testing::holds_under_file_size_limit(
      65'536, [&] { return write_file_atomically(path, large, IfExists::replace).has_value(); }));
  EXPECT_EQ(*read_file(path), "old");
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(AtomicFile, AMissingFolderIsAnErrorThatNamesThePath) {
  const auto path = folder() / "missing" / "result";
  const MaybeError error = write_file_atomically(path, "content", IfExists::replace);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, Error::Kind::write_failed);
  EXPECT_NE(error->message.find(path.string()), std::string::npos);
}

TEST_F(AtomicFile, AFileInPlaceOfTheFolderIsAnError) {
  ASSERT_FALSE(write_file_atomically(folder() / "file", "content", IfExists::replace));
  EXPECT_TRUE(write_file_atomically(folder() / "file" / "result", "content", IfExists::replace));
}

TEST_F(AtomicFile, ReadingTellsMissingFromUnreadable) {
  const Result<std::string> missing = read_file(folder() / "missing");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, Error::Kind::missing);
  const Result<std::string> directory = read_file(folder());
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().kind, Error::Kind::unreadable);
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  const Result<std::string> pipe = read_file(folder() / "pipe");
  ASSERT_FALSE(pipe);
  EXPECT_EQ(pipe.error().kind, Error::Kind::unreadable);
}

}  // namespace
}  // namespace launchsafe::store
