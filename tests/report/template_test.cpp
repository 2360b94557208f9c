#include "launchsafe/report/template.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::report {
namespace {

TEST(Template, IsFilledWithFactsInTheirForms) {
  const Row facts{{"cases", 2},
                  {"gap", 0.01234},
                  {"bytes", 2.5e6},
                  {"time", 185.0},
                  {"unknown", std::nan("")},
                  {"name", "S1"},
                  {"axes", {"pressure", "crack"}},
                  {"none", Row::array()},
                  {"part", {{"inner", "yes"}}}};
  for (const auto& [text, expected] :
       {std::pair{"{{cases|counted case}} over {{axes|list}}", "2 cases over pressure, crack"},
        {"{{gap|sig 3}} {{gap|fixed 1}} {{bytes|mega 2}} {{time|duration}}", "0.0123 0.0 2.5 3 min 05 s"},
        {"{{name|padded 4}}.", "S1  ."},
        {"{{#gap|over 0}}a{{/gap|over 0}}{{#cases|is 2}}b{{/cases|is 2}}{{#cases|over 2}}c{{/cases|over 2}}",
         "ab"},
        {"{{#axes|some}}a{{/axes|some}}{{#none|some}}b{{/none|some}}{{^none|some}}c{{/none|some}}", "ac"},
        {"{{unknown|sig 2}} K", "n/a K"},
        {"{{#axes}}<{{.}}>{{/axes}}{{#part}}{{inner}} {{name}}{{/part}} {{part.inner}}",
         "<pressure><crack>yes S1 yes"},
        {"{{nowhere}}{{^nowhere}}absent{{/nowhere}}", "absent"}})
    EXPECT_EQ(filled(text, {&facts}), expected) << text;
}

TEST(Template, FactsAreNeverATemplateAndTheInnerOnesComeFirst) {
  const Row outer{{"a", "{{b}}"}, {"b", "outer"}}, inner{{"b", "<inner>"}};
  EXPECT_EQ(filled("{{a}} {{b}}", {&outer, &inner}), "{{b}} <inner>");
  EXPECT_THROW(filled("{{#a}}", {&outer}), store::Error);
}

}  // namespace
}  // namespace launchsafe::report
