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

TEST_F(Descriptors, AStderrThatTakesNothingChangesNeitherResultNorExitCode) {
  for (const std::string arguments :
       {"run shell.toml --json", "run absent.toml", "study study.toml -o out"}) {
    const Outcome usual = run_redirected(arguments);
    for (const std::string redirection : {" 2>&-", " 2>/dev/full"}) {
      const Outcome outcome = run_redirected(arguments + redirection);
      EXPECT_EQ(outcome.code, usual.code) << arguments << redirection;
      EXPECT_EQ(outcome.out.empty(), usual.out.empty()) << arguments << redirection;
      EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    }
  }
}

TEST_F(Descriptors, NoFileOfAStudyIsOpenedUnderAStandardNumber) {
  const Outcome usual = run({"study", "study.toml", "-o", "usual"});
  const Outcome closed = run_redirected("study study.toml -o closed <&- >&- 2>&-");
  EXPECT_EQ(closed.code, 70) << "its tables were lost";
  const Outcome again = run({"study", "study.toml", "-o", "closed"});
  EXPECT_EQ(again.code, usual.code) << again.err;
  EXPECT_TRUE(again.says("ran 0")) << again.err;
  EXPECT_FALSE(again.says("damaged")) << again.err;
  expect_same_results("usual", "closed");
}

}  // namespace
}  // namespace launchsafe::app
