// What can be written on the command line, and what the program says about itself.
#include "launchsafe/version.hpp"
#include "program.hpp"

#include <fmt/format.h>

namespace launchsafe::app {
namespace {

class CommandLineProgram : public Program {};

TEST_F(CommandLineProgram, VersionNamesCommitCompilerFlagsAndLibraries) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  const std::vector<std::string> parts{"launchsafe " + std::string(version::number),
                                       "commit",
                                       std::string(version::compiler),
                                       "-std=c++20",
                                       "HDF5",
                                       "Eigen",
                                       "CLI11"};
  for (const std::string& part : parts) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
  }
}

TEST_F(CommandLineProgram, EveryHelpHasExamples) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"run", "--help"},
                                             {"study", "--help"},
                                             {"merge", "--help"},
                                             {"explain", "--help"},
                                             {"plot", "--help"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    EXPECT_NE(outcome.out.find("Examples:\n  launchsafe "), std::string::npos) << outcome.out;
  }
}

TEST_F(CommandLineProgram, TheFirstHelpNamesEverySubcommandAndExitCode) {
  const std::string help = run({"--help"}).out;
  for (const char* part : {"run ", "study ", "merge ", "explain ", "plot ", "0 done", "2 bad", "3 some",
                           "4 a verdict", "70 ", "75 interrupted"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part;
  }
}

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

TEST_F(CommandLineProgram, AMistypedWordIsToldWithTheNearestThereIs) {
  const auto error = [this](const std::vector<std::string>& arguments) { return run(arguments).err; };
  EXPECT_NE(error({"stduy", "study.toml"}).find("found \"stduy\""), std::string::npos);
  EXPECT_NE(error({"stduy", "study.toml"}).find("did you mean study?"), std::string::npos);
  EXPECT_NE(error({"help"}).find("did you mean --help?"), std::string::npos);
  EXPECT_NE(error({"study", "study.toml", "-o", "out", "--job", "2"}).find("did you mean --jobs?"),
            std::string::npos);
  EXPECT_NE(error({"plot", "--widht=3"}).find("plot: found \"--widht\""), std::string::npos);
  EXPECT_NE(error({"--verion"}).find("did you mean --version?"), std::string::npos);
}

TEST_F(CommandLineProgram, AQuantityOfAnOptionIsReadAsThoseOfFiles) {
  const auto error = [this](const char* calibre) {
    return run({"init", "--calibre", calibre, "-o", "out"}).err;
  };
  EXPECT_NE(error("105").find("\"105\", without a unit; allowed: 20 mm to 50 cm"), std::string::npos);
  EXPECT_NE(error("105,5 mm").find("where a comma may be a decimal point"), std::string::npos);
  EXPECT_NE(error("5 m").find("found \"5 m\"; allowed: 20 mm to 50 cm"), std::string::npos);
  // In what unit it was meant nobody knows.
  EXPECT_EQ(error("105").find("did you mean"), std::string::npos);
  for (const auto& [option, amount, units] :
       {std::array{"--tolerance", "2", "(units: K)"}, std::array{"--memory", "8gb", "(units: GB, "},
        std::array{"--memory", "8G", "(units: GB, "},
        std::array{"--time-limit", "10m", "(units: s, min, "}}) {
    const Outcome refused = run({"study", "s.toml", "-o", "out", option, amount});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(refused.says(units)) << refused.err;
    EXPECT_FALSE(refused.says("did you mean")) << refused.err;
  }
}

TEST_F(CommandLineProgram, ACountOfAnOptionIsDecimal) {
  for (const char* jobs : {"0x10", "0b1", "1e1", "1.5", "2 ", "0", "4097", "99999999999"}) {
    const Outcome refused = run({"study", "s.toml", "-o", "out", "--jobs", jobs});
    EXPECT_EQ(refused.code, 2) << jobs;
    EXPECT_TRUE(refused.says(fmt::format("found \"{}\"", jobs))) << refused.err;
  }
}

TEST_F(CommandLineProgram, AnEmptyNameIsRefused) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", ""}, {"study", "study.toml", "-o", ""}, {"report", "", "-o", "x"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("found \"\"; allowed: "), std::string::npos) << outcome.err;
  }
}

TEST_F(CommandLineProgram, AnOutputThatCannotBeWrittenIsAnError) {
  start({"--version"});
  EXPECT_EQ(wait().code, 0);
  std::filesystem::remove(folder() / "stdout.txt");
  std::filesystem::create_symlink("/dev/full", folder() / "stdout.txt");
  start({"--version"});
  // The outcome is taken by hand: /dev/full would be read without end.
  int status = 0;
  ASSERT_EQ(::waitpid(child(), &status, 0), child());
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 70);
  EXPECT_NE(read("stderr.txt").find("standard output"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::app
