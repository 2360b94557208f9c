// What can be written on the command line, and what the program says about itself.
#include "launchsafe/version.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

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
                                             {"emit", "--help"},
                                             {"verify", "--help"},
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
  for (const char* part : {"run ", "study ", "merge ", "emit ", "verify ", "explain ", "plot ", "0 done",
                           "2 bad", "3 some", "4 a verdict", "70 ", "75 interrupted"}) {
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
                                             {"merge", "study.toml"},
                                             {"emit", "cluster", "study.toml", "-o", "out", "--shards", "3"},
                                             {"emit", "slurm", "study.toml", "-o", "out"},
                                             {"explain"},
                                             {"plot"},
                                             {"explain", "scene.toml", "--keys"},
                                             {"verify", "--quiet", "--filter", "no check has this name"}}) {
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

TEST_F(CommandLineProgram, AnOptionOfAnotherCommandIsToldWithThatCommand) {
  EXPECT_TRUE(run({"run", "scene.toml", "--csv"}).says("--csv is an option of plot"));
  const Outcome set = run({"study", "study.toml", "-o", "out", "--set", "load.peak=500 MPa"});
  EXPECT_TRUE(set.says("file sets values: set = { load.peak = \"500 MPa\" } above its first [table]"))
      << set.err;
}

TEST_F(CommandLineProgram, WhatIsMissingIsCalledAsInTheHelpOfItsCommand) {
  const std::pair<std::vector<std::string>, std::string> faults[] = {
      {{"study"}, "STUDY.toml is required (launchsafe study --help shows the usage)"},
      {{"study", "study.toml"}, "file not found"},
      {{"run"}, "SCENE.toml is required (launchsafe run --help"},
      {{"merge", "study.toml"}, "--output is required (launchsafe merge --help"},
      {{"emit", "slurm", "study.toml", "-o", "out"}, "--shards is required (launchsafe emit --help"},
      {{"status"}, "DIR... is required (launchsafe status --help"},
      {{"init", "-o", "out"}, "--calibre is required (launchsafe init --help"},
      {{"report", "out"}, "--output is required (launchsafe report --help"},
      {{"explain"}, "(launchsafe explain --help"},
      {{"study.toml"}, "did you mean launchsafe study study.toml? (launchsafe --help"},
      {{}, "(launchsafe --help"}};
  for (const auto& [arguments, message] : faults) EXPECT_TRUE(run(arguments).says(message)) << message;
}

TEST_F(CommandLineProgram, AnArgumentTooManyIsToldAsOtherWordsAre) {
  EXPECT_TRUE(run({"plot", "a.h5", "b.h5", "c.h5"}).says("plot: found \"b.h5\"; allowed: no more arguments"));
  EXPECT_TRUE(run({"run", "scene.toml", "-x"}).says("run: found \"-x\"; allowed: options of run"));
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
        std::array{"--memory", "8G", "(units: GB, "}, std::array{"--time-limit", "10m", "(units: s, min, "}}) {
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

TEST_F(CommandLineProgram, AShardBeyondTheLastIsRefusedWithTheRange) {
  const std::string error = run({"study", "study.toml", "-o", "out", "--shard", "3/2"}).err;
  EXPECT_NE(error.find("i/N with i from 1 to N"), std::string::npos) << error;
}

TEST_F(CommandLineProgram, AMissingStudyIsToldBeforeAMissingOutput) {
  EXPECT_NE(run({"study", "study.toml"}).err.find("file not found"), std::string::npos);
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

// What bash offers for the last of these words.
TEST_F(CommandLineProgram, BashCompletesCommandsOptionsAndWhatTheyTake) {
  write("a.toml", "");
  write("a.txt", "");
  std::filesystem::create_directory(folder() / "folder");
  write("complete.sh", "eval \"$(" LAUNCHSAFE_PROGRAM
                       " --bash-completion)\"; COMP_WORDS=(launchsafe \"$@\"); COMP_CWORD=$#; _launchsafe; "
                       "echo \"${COMPREPLY[*]}\"\n");
  const std::pair<const char*, const char*> offers[] = {{"st", "study status\n"},
                                                        {"report --i", "--index\n"},
                                                        {"plot --what histories,fi", "histories,fields\n"},
                                                        {"plot --what = air", "air\n"},
                                                        {"explain --schema s", "scene study\n"},
                                                        {"emit sl", "slurm\n"},
                                                        {"run ''", "folder a.toml\n"},
                                                        {"study a.toml -o ''", "folder\n"},
                                                        {"study a.toml --jobs ''", "\n"}};
  for (const auto& [words, offered] : offers) {
    const Outcome outcome = run_in_shell(std::string("bash complete.sh ") + words);
    EXPECT_EQ(outcome.out, offered) << words << outcome.err;
  }
}

TEST_F(CommandLineProgram, VerifyPrintsATableThatTheFilterNarrows) {
  const Outcome outcome = run({"verify", "--filter", "JWL"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("jwl: bulk modulus"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("air: "), std::string::npos);
  EXPECT_EQ(outcome.out.find("FAIL"), std::string::npos);
}

TEST_F(CommandLineProgram, VerifyGivesEveryNumberAsJson) {
  const Outcome outcome = run({"verify", "--filter", "relaxation", "--json"});
  EXPECT_EQ(outcome.code, 0);
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["failed"], 0);
  EXPECT_EQ(object["passed"], object["checks"].size());
  for (const auto& check : object["checks"]) {
    for (const char* key : {"name", "computed", "expected", "error", "tolerance", "source"}) {
      EXPECT_TRUE(check.contains(key)) << key;
    }
    EXPECT_TRUE(check["pass"]);
  }
}

}  // namespace
}  // namespace launchsafe::app
