#include "launchsafe/report/page_texts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

std::vector<std::string> said_by(const std::string& file, const std::string& name, const Row& facts) {
  const auto texts = texts_in(file, "a test");
  EXPECT_TRUE(texts);
  return texts ? said(*texts, name, facts) : std::vector<std::string>{};
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

TEST(PageTexts, TellOneFromMany) {
  const std::string file =
      "@cases\n{{cases|counted other case}} {{#cases|is 1}}is{{/cases|is 1}}{{#cases|over "
      "1}}are{{/cases|over 1}}\n";
  EXPECT_EQ(said_by(file, "cases", {{"cases", 1}}).front(), "1 other case is");
  EXPECT_EQ(said_by(file, "cases", {{"cases", 3}}).front(), "3 other cases are");
}

// A number that is none is neither left out nor taken for a value.
TEST(PageTexts, PrintWhatIsNotANumber) {
  EXPECT_EQ(said_by("@bound\n{{K|sig 2}} K\n", "bound", {{"K", std::nan("")}}).front(), "n/a K");
}

}  // namespace
}  // namespace launchsafe::report
