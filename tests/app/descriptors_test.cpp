// Standard descriptors that are closed, full or gone: a lost result is noticed, lost messages are not.
#include "stored_study.hpp"

namespace launchsafe::app {
namespace {

class Descriptors : public StoredStudy {
 protected:
  /// The program in a shell, with redirections behind its arguments.
  Outcome run_redirected(const std::string& arguments_and_redirections) {
    return run_in_shell("\"" LAUNCHSAFE_PROGRAM "\" " + arguments_and_redirections);
  }
};

TEST_F(Descriptors, ResultsThatStdoutDoesNotTakeAreExitCode70) {
  for (const std::string arguments : {"--version", "--help", "study --help", "--version --json",
                                      "explain --keys", "explain shell.toml --json", "run shell.toml",
                                      "run shell.toml --json", "study study.toml --dry-run"}) {
    for (const std::string redirection : {" >&-", " >/dev/full"}) {
      const Outcome outcome = run_redirected(arguments + redirection);
      EXPECT_EQ(outcome.code, 70) << arguments << redirection << "\n" << outcome.err;
      EXPECT_TRUE(outcome.says("standard output")) << arguments << redirection << "\n" << outcome.err;
    }
  }
}

TEST_F(Descriptors, AReaderThatHasGoneIsNoLoss) {
  const Outcome outcome =
      run_in_shell("{ \"" LAUNCHSAFE_PROGRAM "\" explain --keys; echo $? > code; } | true");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(read("code"), "0\n") << outcome.err;
}

}  // namespace
}  // namespace launchsafe::app
