// A program that is called: what it is given, and what it leaves. That it is ended in time is tested where
// pictures are drawn.
#include "launchsafe/store/file.hpp"

#include <gtest/gtest.h>

namespace launchsafe::store {
namespace {

TEST(CalledProgram, ReadsItsInputAndLeavesItsOutput) {
  const auto run = run_program("cat", {}, "here\n");
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_TRUE(run->succeeded);
  EXPECT_EQ(run->output, "here\n");
}

TEST(CalledProgram, ThatIsNotInstalledIsMissing) {
  const auto run = run_program("launchsafe-no-such-program", {}, "");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, Error::Kind::missing);
}

}  // namespace
}  // namespace launchsafe::store
