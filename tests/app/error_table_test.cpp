// launchsafe verify --error-against-time, as a user would start it.
#include "program.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace launchsafe::app {
namespace {

class ErrorTableProgram : public Program {};

TEST_F(ErrorTableProgram, PrintsErrorsOrdersAndTimesAndTheCommandThatMadeThem) {
  const Outcome outcome = run({"verify", "--error-against-time", "--filter", "AIR RISING"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part :
       {"exchange with the air", "step 4.5 ms", "processor time", "order", "exact solution",
        "made by: launchsafe verify --error-against-time --filter 'AIR RISING'"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  }
  EXPECT_EQ(outcome.out.find("bar wave"), std::string::npos) << outcome.out;
  EXPECT_FALSE(exists("parts.md"));
}

TEST_F(ErrorTableProgram, GivesEveryNumberAsJson) {
  const Outcome outcome =
      run({"verify", "--error-against-time", "--filter", "air rising", "--json", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["command"], "launchsafe verify --error-against-time --filter 'air rising'");
  ASSERT_EQ(object["series"].size(), 2U);
  const auto& linear = object["series"][0];
  EXPECT_TRUE(linear["exact"]);
  EXPECT_TRUE(linear["order_expected"].is_null());
  const auto& square = object["series"][1];
  EXPECT_DOUBLE_EQ(square["order_expected"], 2.0);  // the air is linear over a step
  const auto& settings = square["settings"];
  ASSERT_EQ(settings.size(), 5U);
  EXPECT_TRUE(settings[0]["order"].is_null());
  for (std::size_t k = 1; k < settings.size(); ++k) {
    EXPECT_LT(settings[k]["error"], settings[k - 1]["error"]);
    EXPECT_GT(settings[k]["processor_time_s"], 0.0);
  }
  EXPECT_NEAR(settings[4]["order"], 2.0, 0.01);
}

TEST_F(ErrorTableProgram, WritesPageTableAndPicture) {
  const Outcome outcome =
      run({"verify", "--error-against-time", "--filter", "air rising", "-o", "deep/parts"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = read("deep/parts/parts.md"), table = read("deep/parts/parts.csv");
  EXPECT_NE(page.find("`launchsafe verify --error-against-time --filter 'air rising' -o DIR`"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("| T, air rising as time squared | step 17.6 us |"), std::string::npos) << page;
  EXPECT_EQ(
      table.rfind("part,quantity,setting,size,error,error_unit,order,order_expected,processor_time_s", 0), 0U)
      << table;
  std::size_t lines = 0;
  for (const char letter : table) lines += letter == '\n' ? 1 : 0;
  EXPECT_EQ(lines, 11U);  // the header, and twice five settings
  if (outcome.says("no picture")) {
    EXPECT_FALSE(exists("deep/parts/parts.svg"));
    EXPECT_EQ(page.find("parts.svg"), std::string::npos);
  } else {
    EXPECT_NE(read("deep/parts/parts.svg").find("</svg>"), std::string::npos);
    EXPECT_NE(page.find("(parts.svg)"), std::string::npos);
  }
}

TEST_F(ErrorTableProgram, RefusesAFolderWithoutTheTableAndAFilterWithoutAName) {
  const Outcome folder = run({"verify", "-o", "parts"});
  EXPECT_EQ(folder.code, 2);
  EXPECT_TRUE(folder.says("--error-against-time")) << folder.err;
  EXPECT_FALSE(exists("parts"));
  const Outcome filter = run({"verify", "--error-against-time", "--filter", "warp drive", "-o", "parts"});
  EXPECT_EQ(filter.code, 2);
  EXPECT_TRUE(filter.says("bar wave")) << filter.err;
  EXPECT_TRUE(filter.out.empty());
  EXPECT_FALSE(exists("parts"));
  write("file", "");
  const Outcome file = run({"verify", "--error-against-time", "--filter", "air rising", "-o", "file"});
  EXPECT_EQ(file.code, 2);
  EXPECT_TRUE(file.says("--output")) << file.err;
}

}  // namespace
}  // namespace launchsafe::app
