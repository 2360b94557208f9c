#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/file.hpp"
#include "launchsafe/version.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

namespace launchsafe::store {
namespace {

TEST(Manifest, NamesInputProgramAndMachine) {
  const Manifest manifest = make_manifest("title = 'shell'", 2);
  EXPECT_EQ(manifest.input_text, "title = 'shell'");
  EXPECT_EQ(manifest.input_sha256, sha256("title = 'shell'"));
  EXPECT_EQ(manifest.program_version, version::number);
  EXPECT_EQ(manifest.commit, version::commit);
  EXPECT_EQ(manifest.compiler, version::compiler);
  EXPECT_FALSE(manifest.host.empty());
  EXPECT_EQ(manifest.threads, 2);
}

TEST(Manifest, StartsNowInUtc) {
  EXPECT_TRUE(std::regex_match(utc_now(), std::regex(R"(20\d\d-[01]\d-[0-3]\dT[0-2]\d:[0-5]\d:[0-6]\dZ)")));
}

}  // namespace
}  // namespace launchsafe::store
