#include "launchsafe/report/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

std::vector<std::string> said_by(const std::string& file, const std::string& name, const Row& facts) {
  return said(texts_in(file, "a test"), name, facts);
}

TEST(PageTexts, SayWhatStandsUnderAName) {
  const std::string file =
      "@answer.size\n{{cases|counted case}} over {{axes|and}}.\n@answer.none\n{{#failed|over "
      "0}}never{{/failed|over 0}}\n"
      "@answer.case\n= item of rows where verdict SAFE\n{{gap_cm|sig 3}} cm of {{total}}\n@answers\nanother "
      "place\n";
  const Row facts{
      {"cases", 1},
      {"failed", 0},
      {"total", 2},
      {"axes", {"pressure", "crack", "flaw"}},
      {"rows", {{{"gap_cm", 0.01234}, {"verdict", "SAFE"}}, {{"gap_cm", 0.05}, {"verdict", "UNSAFE"}}}}};
  EXPECT_EQ(said_by(file, "answer", facts),
            (std::vector<std::string>{"1 case over pressure, crack and flaw.", "0.0123 cm of 2"}));
  EXPECT_EQ(said_by(file, "answer.case", Row::object()), std::vector<std::string>{});
}

// 526.8 is not over 526.9, which its whole part is not to hide.
TEST(PageTexts, TellWhetherANumberIsOverAnotherFact) {
  const std::string file = "@hot\n{{#hot_K|over limit_K}}over{{/hot_K|over limit_K}}\n";
  EXPECT_EQ(said_by(file, "hot", {{"hot_K", 526.8}, {"limit_K", 526.7}}), std::vector<std::string>{"over"});
  EXPECT_EQ(said_by(file, "hot", {{"hot_K", 526.8}, {"limit_K", 526.9}}), std::vector<std::string>{});
}

TEST(PageTexts, TellHowManyRowsHaveSomething) {
  const Row facts{{"rows",
                   {{{"verdict", "SAFE"}, {"warning", ""}, {"fault", nullptr}},
                    {{"verdict", "INDETERMINATE"}, {"warning", ""}, {"fault", "drift"}}}}};
  const std::string file =
      "@any\n{{#rows|any warning fault}}faults{{/rows|any warning fault}}{{#rows|any "
      "warning}}warnings{{/rows|any "
      "warning}}\n"
      "@count\n{{rows|count verdict SAFE}} of {{rows|count}}{{#rows|count verdict UNSAFE|over 0}}, some "
      "UNSAFE{{/rows|count verdict UNSAFE|over 0}}\n";
  EXPECT_EQ(said_by(file, "any", facts), std::vector<std::string>{"faults"});
  EXPECT_EQ(said_by(file, "count", facts), std::vector<std::string>{"1 of 2"});
}

// What is not known is no reason to tell the smallest that is.
TEST(PageTexts, ChooseTheRowsThatAreLowestOrNotKnown) {
  Row facts{{"rows",
             {{{"case", "a"}, {"K", 300}, {"cm", 0.03}},
              {{"case", "b"}, {"K", 340}, {"cm", 0.02}},
              {{"case", "c"}, {"K", 340}, {"cm", 0.01}}}}};
  const std::string file =
      "@hot\n= item of rows largest K lowest cm\n{{case}}\n@bound\n= item of rows with cm\n{{case}}\n";
  EXPECT_EQ(said_by(file, "hot", facts), std::vector<std::string>{"c"});
  facts["rows"][1]["cm"] = nullptr;
  EXPECT_EQ(said_by(file, "hot", facts), std::vector<std::string>{"b"});
  EXPECT_EQ(said_by(file, "bound", facts), (std::vector<std::string>{"a", "c"}));
}

// A number that is none is neither left out nor taken for a value.
TEST(PageTexts, PrintWhatIsNotANumber) {
  EXPECT_EQ(said_by("@bound\n{{K|sig 2}} K\n", "bound", {{"K", std::nan("")}}).front(), "n/a K");
}

}  // namespace
}  // namespace launchsafe::report
