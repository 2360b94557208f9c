#include "launchsafe/store/file.hpp"

#include "child_process.hpp"
#include "store_fixture.hpp"

#include <sys/stat.h>

namespace launchsafe::store {
namespace {

using File = launchsafe::testing::TemporaryFolder;
using launchsafe::testing::kind_of;
using Names = std::vector<std::string>;

TEST_F(File, IsReplacedOnlyWhereThatIsAskedFor) {
  const auto path = folder() / "result";
  const std::string content("first \0second", 13);
  write_file_atomically(path, content, IfExists::refuse);
  EXPECT_EQ(kind_of([&] { write_file_atomically(path, "new", IfExists::refuse); }), Error::Kind::conflict);
  EXPECT_EQ(read_file(path), content);
  write_file_atomically(path, "new", IfExists::replace);
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(listing(), Names{"result"});
  const mode_t mask = ::umask(0);
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0666 & ~mask) << "as readable as any file of the user";
}

TEST_F(File, IsWrittenBesideTheProgramWhenItsPathHasNoFolder) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder());
  write_file_atomically("result", "content", IfExists::replace);
  std::filesystem::current_path(before);
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(File, AFullDiskLeavesNothingBehindAndTheOldFileAsItWas) {
  const auto path = folder() / "result";
  const auto fails = [&] {
    return launchsafe::testing::holds_under_file_size_limit(65'536, [&] {
      return kind_of([&] { write_file_atomically(path, std::string(100'000, 'x'), IfExists::replace); }) ==
             Error::Kind::write_failed;
    });
  };
  EXPECT_TRUE(fails());
  EXPECT_EQ(listing(), Names{});
  write_file_atomically(path, "old", IfExists::replace);
  EXPECT_TRUE(fails());
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(listing(), Names{"result"});
}

TEST_F(File, CannotBeWrittenWithoutAFolder) {
  write_file_atomically(folder() / "file", "content", IfExists::replace);
  for (const char* place : {"missing/result", "file/result"})
    EXPECT_EQ(kind_of([&] { write_file_atomically(folder() / place, "content", IfExists::replace); }),
              Error::Kind::write_failed);
}

TEST_F(File, ThatIsMissingIsToldFromOneThatCannotBeRead) {
  EXPECT_EQ(kind_of([&] { read_file(folder() / "missing"); }), Error::Kind::missing);
  EXPECT_EQ(kind_of([&] { read_file(folder()); }), Error::Kind::unreadable);
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(kind_of([&] { read_file(folder() / "pipe"); }), Error::Kind::unreadable);
}

TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(CalledProgram, ReadsItsInputAndLeavesItsOutput) {
  const auto run = run_program("sh", {"-c", "cat; echo 'it failed' >&2; exit 3"}, "here\n");
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_FALSE(run->succeeded);
  EXPECT_EQ(run->output, "here\n");
  EXPECT_EQ(run->errors, "it failed\n");
}

TEST(CalledProgram, ThatIsNotInstalledOrTakesTooLongIsAnError) {
  EXPECT_EQ(run_program("launchsafe-no-such-program", {}, "").error().kind, Error::Kind::missing);
  EXPECT_EQ(run_program("sleep", {"100"}, "", {.time = 0.2}).error().kind, Error::Kind::failed);
  const std::atomic<bool> stop{true};
  EXPECT_EQ(run_program("cat", {}, "", {.stop = &stop}).error().kind, Error::Kind::failed);
}

}  // namespace
}  // namespace launchsafe::store
