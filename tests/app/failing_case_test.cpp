// A case that fails is its row: the others are not affected, and what would fail again is not tried again.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class FailingCase : public StoredStudy {};

TEST_F(FailingCase, ADriftOfEnergyIsItsRowAndIsNotComputedAgain) {
  write("study.toml", R"(kind = "critical-gap"
scene = "shell.toml"
confirm = false
gaps = "0, 0.01 cm"
largest_gap = "1 cm"
early_time = "0.03 ms"
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }

[[vary]]
key = "peak_pressure"
values = "250, 260 MPa"

[[vary]]
key = "numerics.energy_drift_limit"
values = [1e-10, 0.5]
)");
  const Outcome first = run({"study", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(first.code, 3);
  const auto verdicts = nlohmann::json::parse(first.out)["verdicts"];
  ASSERT_EQ(verdicts.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(verdicts[i]["reason_code"] == "failed", i / 2 % 2 == 0) << verdicts[i];
  const Outcome again = run({"study", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(again.code, 3);
  EXPECT_TRUE(again.says("re-used 4 mechanical runs, ran 0")) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["verdicts"], verdicts);
}

}  // namespace
}  // namespace launchsafe::app
