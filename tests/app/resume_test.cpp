// A study that was stopped, or met a full disk or a second process, goes on with what it has.
#include "facts_in_text.hpp"
#include "stored_study.hpp"

#include <sys/resource.h>

namespace launchsafe::app {
namespace {

const std::vector<std::string> study_into_out{"study", "study.toml", "-o", "out", "--jobs", "2"};
const std::vector<std::string> study_alone{"study", "study.toml", "-o", "alone", "--jobs", "2"};

class StoppedStudy : public StoredStudy, public ::testing::WithParamInterface<int> {};

TEST_P(StoppedStudy, NamesTheCommandThatCompletesIt) {
  write("shell.toml", brief_scene());
  write("the study's.toml", sweep_study);
  const std::string output = "an output";
  start({"study", "the study's.toml", "-o", output, "--jobs", "2", "--memory=500MB", "--time-limit", "2min"});
  wait_for_a_case(output);
  send(GetParam());
  const Outcome stopped = wait();
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_TRUE(stopped.out.empty());
  EXPECT_TRUE(testing::in_order(stopped.err, {" kept in ", output})) << stopped.err;
  const std::string mark = "to go on: ";
  const std::size_t at = stopped.err.find(mark);
  ASSERT_NE(at, std::string::npos);
  const std::size_t done = done_cases(output).size();
  const Outcome completed = run_in_shell(stopped.err.substr(at + mark.size()));
  EXPECT_EQ(completed.code, 0) << completed.err;
  EXPECT_TRUE(completed.says("re-used " + std::to_string(done))) << completed.err;
  ASSERT_EQ(run({"study", "the study's.toml", "-o", "alone"}).code, 0);
  expect_same_results("alone", output);
}

INSTANTIATE_TEST_SUITE_P(Signals, StoppedStudy, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "Interrupt" : "Terminate"; });

class FullDisk : public StoredStudy {};

TEST_F(FullDisk, AFileThatMayNotGrowEndsTheStudyWhichGoesOnOnceThereIsSpace) {
  before_start([] {
    constexpr rlimit small{20'000, 20'000};
    ::setrlimit(RLIMIT_FSIZE, &small);
  });
  const Outcome full = run(study_into_out);
  EXPECT_EQ(full.code, 70) << full.err;
  EXPECT_EQ(full.lines_of_error(), 1) << full.err;
  EXPECT_TRUE(full.out.empty());
  EXPECT_FALSE(exists("out/report.md"));
  const std::size_t kept = whole_cases("out").size();
  EXPECT_LT(kept, 12u);
  before_start({});
  const Outcome completed = run(study_into_out);
  EXPECT_EQ(completed.code, 0) << completed.err;
  EXPECT_TRUE(completed.says("re-used " + std::to_string(kept) + " mechanical run")) << completed.err;
  ASSERT_EQ(run(study_alone).code, 0);
  expect_same_results("alone", "out");
}

class ResumedStudy : public StoredStudy {};

TEST_F(ResumedStudy, ASecondProcessIsRefused) {
  write("shell.toml", brief_scene());
  start(study_into_out);
  wait_for_a_case("out");
  const Outcome second = run_beside(study_into_out);
  EXPECT_EQ(second.code, 2) << second.err;
  EXPECT_EQ(second.lines_of_error(), 1) << second.err;
  EXPECT_TRUE(second.says("out is in use")) << second.err;
  EXPECT_EQ(wait().code, 0);
  EXPECT_EQ(done_cases("out").size(), 12u);
}

}  // namespace
}  // namespace launchsafe::app
