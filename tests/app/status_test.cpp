// launchsafe status, and the end of a study at a time of the day.
#include "launchsafe/store/case_store.hpp"
#include "stored_study.hpp"

#include <ctime>

namespace launchsafe::app {
namespace {

class Status : public StoredStudy {
 protected:
  /// The facts of a folder.
  nlohmann::json status_of(const std::string& name, int code) {
    const Outcome outcome = run_beside({"status", "--json", name});
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return nlohmann::json::parse(outcome.out)["folders"][0];
  }
  void start_long_study() {
    write("shell.toml", long_scene());
    start({"study", "study.toml", "-o", "out", "--jobs", "1"});
    wait_until([this] {
      const auto found = store::status_in(folder() / "out");
      return found && found->alive && found->cases == 24 && found->exit_code < 0;
    });
  }
};

TEST_F(Status, OfAFinishedStudyAndItsShards) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
  const auto status = status_of("out", 0);
  EXPECT_EQ(status["state"], "finished");
  EXPECT_EQ(status["cases"], 24);
  EXPECT_EQ(status["cases_done"], 24);
  for (const std::string shard : {"1/2", "2/2"})
    ASSERT_EQ(run({"study", "study.toml", "-o", "own-" + shard.substr(0, 1), "--shard", shard}).code, 0);
  const Outcome both = run({"status", "own-1", "own-2", "--json"});
  EXPECT_EQ(both.code, 0);
  const auto folders = nlohmann::json::parse(both.out)["folders"];
  ASSERT_EQ(folders.size(), 2u);
  EXPECT_EQ(folders[1]["shard"], "2/2");
  EXPECT_EQ(folders[0]["cases_done"].get<int>() + folders[1]["cases_done"].get<int>(), 24);
  EXPECT_EQ(run({"status", "nowhere"}).code, 2);
}

TEST_F(Status, OfAStudyThatRunsAndOfOneThatWasInterruptedOrKilled) {
  for (const int signal : {SIGINT, SIGKILL}) {
    start_long_study();
    const auto running = status_of("out", 0);
    EXPECT_EQ(running["state"], "running");
    EXPECT_EQ(running["cases_done"], 0);
    send(signal);
    EXPECT_EQ(wait().code, signal == SIGINT ? 75 : -1);
    const auto status = status_of("out", 75);
    EXPECT_EQ(status["state"], "interrupted");
    EXPECT_EQ(status["cases_failed"], 0);
    EXPECT_TRUE(status["command"].get<std::string>().ends_with("study study.toml -o out --jobs 1"));
  }
}

}  // namespace
}  // namespace launchsafe::app
