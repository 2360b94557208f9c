// launchsafe verify --finite-elements, as a user would start it; the comparison itself has the label fem.
#include "program.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace launchsafe::app {
namespace {

class FiniteElementProgram : public Program {};

TEST_F(FiniteElementProgram, SaysInOneLineThatCcxIsMissing) {
  before_start([] { ::setenv("PATH", "/nowhere", 1); });
  const Outcome outcome = run({"verify", "--finite-elements", "-o", "stresses"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("ccx")) << outcome.err;
  EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  EXPECT_TRUE(outcome.out.empty());
  EXPECT_FALSE(exists("stresses"));
}

TEST_F(FiniteElementProgram, IsRefusedTogetherWithTheTableOfErrors) {
  EXPECT_EQ(run({"verify", "--finite-elements", "--error-against-time"}).code, 2);
}

/// A stand-in for ccx that leaves nothing behind: what it says last is the reason.
TEST_F(FiniteElementProgram, SaysWhyCcxFailed) {
  write("ccx", "#!/bin/sh\n[ \"$1\" = -v ] && echo This is Version 9.9 || echo ' *ERROR: out of beans'\n");
  std::filesystem::permissions(folder() / "ccx", std::filesystem::perms::owner_all);
  before_start([path = folder().string() + ":/bin:/usr/bin"] { ::setenv("PATH", path.c_str(), 1); });
  const Outcome outcome = run({"verify", "--finite-elements", "--filter", "bar"});
  EXPECT_EQ(outcome.code, 70);
  EXPECT_TRUE(outcome.says("out of beans")) << outcome.err;
  EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  const Outcome filter = run({"verify", "--finite-elements", "--filter", "warp drive"});
  EXPECT_EQ(filter.code, 2);
  EXPECT_TRUE(filter.says("free bar")) << filter.err;
}

}  // namespace
}  // namespace launchsafe::app
