// Faults of the input end the program before it computes or writes anything. Examples: read_scene_test.cpp
// has more.
#include "program.hpp"

#include <vector>

namespace launchsafe::app {
namespace {

struct Fault {
  std::string name;
  std::string from, to;              ///< what is changed in the valid scene
  std::vector<std::string> message;  ///< what the one message names
};

class BadInputProgram : public Program, public ::testing::WithParamInterface<Fault> {};

TEST_P(BadInputProgram, EndsWithOneMessageAndNoOutput) {
  const Fault& fault = GetParam();
  const std::string scene = with(tiny_scene, fault.from, fault.to);
  write("shell.toml", scene);
  const Outcome outcome = run({"run", "shell.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  EXPECT_TRUE(outcome.says("shell.toml:")) << outcome.err;
  for (const std::string& part : fault.message)
    EXPECT_TRUE(outcome.says(part)) << part << " in " << outcome.err;
  EXPECT_FALSE(exists("out"));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, BadInputProgram,
    ::testing::Values(
        Fault{"SyntaxError", "[load]", "[load", {":3:"}},
        Fault{"UnknownKey", "peak_time = ", "peek_time = ", {":7:", "load.peek_time", "peak_time"}},
        Fault{"WrongUnit", "\"50 MPa\"", "\"50 ms\"", {":6:", "load.peak", "50 ms", "MPa"}},
        Fault{"MissingCurveFile", "exponent = 3", "curve = \"none.csv\"", {":8:", "load.curve", "none.csv"}}),
    [](const auto& test) { return test.param.name; });

class MissingInputProgram : public Program {};

TEST_F(MissingInputProgram, IsNamedByEverySubcommandThatReadsOne) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"run", "absent.toml", "-o", "out"},
                                             {"study", "absent.toml", "-o", "out"},
                                             {"explain", "absent.toml"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments.front();
    EXPECT_TRUE(outcome.says("absent.toml")) << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  }
  EXPECT_FALSE(exists("out"));
}

class CommandLineProgram : public Program {};

TEST_F(CommandLineProgram, SenselessCommandLinesAreBadUsage) {
  write("scene.toml", tiny_scene);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"launch"},
                                             {"run"},
                                             {"run", "scene.toml", "--fast"},
                                             {"run", "scene.toml", "more"},
                                             {"study", "study.toml"},
                                             {"study", "study.toml", "-o", "out", "--jobs", "0"},
                                             {"study", "study.toml", "-o", "out", "--jobs", "two"},
                                             {"study", "study.toml", "-o", "out", "--memory", "much"},
                                             {"study", "study.toml", "-o", "out", "--time-limit", "0s"},
                                             {"study", "study.toml", "-o", "out", "--shard", "3/2"},
                                             {"run", "scene.toml", "-x"},
                                             {"merge", "study.toml"},
                                             {"explain"},
                                             {"plot"},
                                             {"explain", "scene.toml", "--keys"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << (arguments.empty() ? "" : arguments.front());
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  }
  EXPECT_FALSE(exists("out"));
}

TEST_F(CommandLineProgram, ACountOfAnOptionIsDecimal) {
  for (const char* jobs : {"0x10", "0b1", "1e1", "1.5", "2 ", "0", "4097", "99999999999"}) {
    const Outcome refused = run({"study", "s.toml", "-o", "out", "--jobs", jobs});
    EXPECT_EQ(refused.code, 2) << jobs;
  }
}

}  // namespace
}  // namespace launchsafe::app
