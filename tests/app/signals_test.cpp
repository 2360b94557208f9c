// Signals, terminals and closed pipes.
#include "stored_study.hpp"

#include <cstdlib>

namespace launchsafe::app {
namespace {

class SignalledProgram : public Program, public ::testing::WithParamInterface<int> {};

TEST_P(SignalledProgram, EndsAndNamesTheCommandToRunAgain) {
  write("shell.toml", long_scene());
  start({"run", "shell.toml", "-o", "out"});
  wait_for_file("out");
  send(GetParam());
  const Outcome outcome = wait();
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(outcome.says("launchsafe run shell.toml -o out")) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder() / "out"));
}

TEST_P(SignalledProgram, EndsWhilePlanningAMillionCases) {
  write("shell.toml", tiny_scene);
  std::string study = "kind = \"critical-gap\"\nscene = \"shell.toml\"\nearly_time = \"0.1 ms\"\n";
  for (const auto& [key, first, unit] :
       {std::tuple{"peak_pressure", 300.0, "MPa"}, {"crack_radius", 30.0, "um"}, {"flaw_size", 1.0, "mm"}}) {
    study += fmt::format("[[vary]]\nkey = \"{}\"\nvalues = \"{}", key, first);
    for (int i = 1; i < 100; ++i) study += fmt::format(", {:.6g}", first * (1.0 + 0.003 * i));
    study += fmt::format(" {}\"\n", unit);
  }
  write("study.toml", study);
  start({"study", "study.toml", "--dry-run"});
  wait_until_it_catches(SIGTERM);
  send(GetParam());
  const Outcome outcome = wait();
  EXPECT_EQ(outcome.code, 75) << outcome.err;
  EXPECT_TRUE(outcome.says("launchsafe study study.toml --dry-run")) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalledProgram, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& test) { return test.param == SIGINT ? "Interrupt" : "Terminate"; });

class TerminalProgram : public Program {
 protected:
  /// What the program shows on a terminal; it is interrupted as soon as it has shown `last`.
  std::string shown(const std::vector<std::string>& arguments, const std::string& last) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0) return "no terminal";
    const int other_end = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY);
    ::setenv("TERM", "xterm", 1);
    start(arguments, other_end);
    ::close(other_end);
    std::string text;
    bool interrupted = false;
    char letters[256];
    for (ssize_t count = 0; (count = ::read(terminal, letters, sizeof letters)) > 0;) {
      text.append(letters, static_cast<std::size_t>(count));
      if (!interrupted && text.find(last) != std::string::npos) {
        send(SIGINT);
        interrupted = true;
      }
    }
    ::close(terminal);
    EXPECT_EQ(wait().code, interrupted ? 75 : 0);
    return text;
  }
};

TEST_F(TerminalProgram, ShowsOneLineThatIsRewrittenAndThenRemoved) {
  write("shell.toml", long_scene());
  const std::string text = shown({"run", "shell.toml"}, "of 500 ms");
  if (text == "no terminal") GTEST_SKIP() << text;
  EXPECT_NE(text.find("of 500 ms"), std::string::npos) << text;
  const std::size_t erased = text.rfind("\r\x1b[K");
  ASSERT_NE(erased, std::string::npos);
  EXPECT_EQ(text.find('\n'), text.rfind('\n')) << text;  // only the last message ends a line
  EXPECT_GT(text.find("launchsafe: interrupted"), erased);
}

}  // namespace
}  // namespace launchsafe::app
