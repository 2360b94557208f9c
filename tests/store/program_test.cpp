// A program that is called: where it runs, and what it leaves. That it is ended in time is tested where
// pictures are drawn.
#include "launchsafe/store/program.hpp"

#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace launchsafe::store {
namespace {

class CalledProgram : public testing::TemporaryFolder {};

TEST_F(CalledProgram, RunsInTheFolderItIsGiven) {
  std::ofstream(folder() / "note") << "here\n";
  const auto run = run_program("cat", {"note"}, "", {}, folder());
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_TRUE(run->succeeded);
  EXPECT_EQ(run->output, "here\n");
}

TEST_F(CalledProgram, ThatIsNotInstalledIsMissing) {
  const auto run = run_program("launchsafe-no-such-program", {}, "", {}, folder());
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, Error::Kind::missing);
}

}  // namespace
}  // namespace launchsafe::store
