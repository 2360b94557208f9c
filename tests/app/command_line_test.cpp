// What can be written on the command line.
#include "program.hpp"

namespace launchsafe::app {
namespace {

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
