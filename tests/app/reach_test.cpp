// What no machine could finish is refused before it begins, and foreseen at once.
#include "stored_study.hpp"

#include <sys/resource.h>

namespace launchsafe::app {
namespace {

class Reach : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    write("fine.toml", with(tiny_scene, "\"5 mm\"", "\"0.01 mm\""));
    write("slow.toml", with(tiny_scene, "[numerics]", "[numerics]\ntime_step_factor = 1e-300"));
  }
};

TEST_F(Reach, ARunThatCouldNotEndIsRefusedWithKeyAndReason) {
  const Outcome slow = run({"run", "slow.toml", "-o", "out"});
  EXPECT_EQ(slow.code, 2);
  EXPECT_EQ(slow.lines_of_error(), 1) << slow.err;
  EXPECT_TRUE(slow.says("slow.toml:14:")) << slow.err;
  EXPECT_TRUE(slow.says("numerics.time_step_factor")) << slow.err;
  EXPECT_TRUE(slow.says("30 days")) << slow.err;
  const Outcome bounded = run({"run", "shell.toml", "-o", "out", "--longest-run", "1e-5s"});
  EXPECT_EQ(bounded.code, 2) << bounded.err;
  EXPECT_TRUE(bounded.says("numerics.cell_size")) << bounded.err;
  EXPECT_TRUE(bounded.says("a run of at most 1e-05 s")) << bounded.err;
  EXPECT_FALSE(exists("out"));
  EXPECT_EQ(run({"run", "shell.toml", "--longest-run", "90d"}).code, 0);
}

TEST_F(Reach, OneCaseThatIsRefusedIsItsRow) {
  write("study.toml",
        "kind = \"critical-gap\"\nconfirm = false\ngaps = \"0, 0.01 cm\"\nscene = "
        "\"shell.toml\"\nmodel_form_uncertainty = { value = \"1 K\", because = "
        "\"for a test\" }\nearly_time = \"0.03 "
        "ms\"\ninput_uncertainty = { value = \"2 K\", because = \"for a test\" }\n"
        "[[vary]]\nkey = \"numerics.time_step_factor\"\nvalues = [1e-300, 0.5]\n");
  const Outcome outcome = run({"study", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["failures"].size(), 1u) << outcome.out;
  const auto text_of = [&object](std::size_t i) {
    return object["cases"][i].dump() + object["verdicts"][2 * i].dump() +
           object["verdicts"][2 * i + 1].dump();
  };
  const std::string refused = text_of(0), computed = text_of(1);
  EXPECT_NE(refused.find("30 days"), std::string::npos) << refused;
  EXPECT_EQ(refused.find("\"SAFE\""), std::string::npos) << refused;
  EXPECT_EQ(computed.find("30 days"), std::string::npos) << computed;
  EXPECT_EQ(done_cases("out").size(), 1u);
  const Outcome foreseen = run({"study", "study.toml", "--dry-run"});
  EXPECT_EQ(foreseen.code, 0) << foreseen.err;
  EXPECT_NE(foreseen.out.find("2 for 2 cases; 1 refused; 0 stored, 1 to run"), std::string::npos)
      << foreseen.out;
  EXPECT_NE(foreseen.out.find("refused: numerics.time_step_factor"), std::string::npos) << foreseen.out;
}

TEST_F(Reach, AStudyOfRefusedCasesAloneIsNotBegun) {
  write("study.toml", with(sweep_study, "shell.toml", "slow.toml"));
  const Outcome outcome = run({"study", "study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  EXPECT_FALSE(exists("out"));
}

TEST_F(Reach, ExplainingAnyMeshTakesLittleMemory) {
  constexpr rlim_t gibibyte = 1u << 30;
  before_start([] {
    const rlimit limit{gibibyte, gibibyte};
    ::setrlimit(RLIMIT_AS, &limit);
  });
  write("study.toml", with(sweep_study, "shell.toml", "fine.toml"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"explain", "fine.toml", "--json"},
                                             {"explain", "slow.toml", "--json"},
                                             {"explain", "study.toml", "--json"},
                                             {"study", "study.toml", "--dry-run", "--json"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments[1] << outcome.err;
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
  }
}

}  // namespace
}  // namespace launchsafe::app
