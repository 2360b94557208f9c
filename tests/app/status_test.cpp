// launchsafe status, and the end of a study at a time of the day.
#include "launchsafe/store/case_store.hpp"
#include "stored_study.hpp"

#include <ctime>

namespace launchsafe::app {
namespace {

class Status : public StoredStudy {
 protected:
  nlohmann::json status_of(const std::vector<std::string>& folders, int code) {
    std::vector<std::string> command{"status", "--json"};
    command.insert(command.end(), folders.begin(), folders.end());
    const Outcome outcome = run_beside(command);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(Status, SaysWhatAFinishedStudyDid) {
  ASSERT_EQ(run({"study", "study.toml", "-o", "out"}).code, 0);
  const auto status = status_of({"out"}, 0);
  EXPECT_EQ(status["state"], "finished");
  EXPECT_EQ(status["cases"], 24);
  EXPECT_EQ(status["cases_done"], 24);
  EXPECT_EQ(status["runs_stored"], 12);
}

TEST_F(Status, IsReadBesideARunningStudyAndSaysWhatAnInterruptionLeft) {
  write("shell.toml", long_scene());
  start({"study", "study.toml", "-o", "out", "--jobs", "1"});
  wait_until([this] {
    const auto found = store::statuses_in(folder() / "out");
    return !found.empty() && found.front().members.value("runs_running", 0) == 1;
  });
  const auto running = status_of({"out"}, 0);
  EXPECT_EQ(running["state"], "running");
  EXPECT_EQ(running["cases_done"], 0);
  send(SIGINT);
  EXPECT_EQ(wait().code, 75);
  const auto status = status_of({"out"}, 75);
  EXPECT_EQ(status["state"], "interrupted");
  EXPECT_EQ(status["cases_done"], 0);
  EXPECT_EQ(status["cases_failed"], 0);
  EXPECT_TRUE(status["command"].get<std::string>().ends_with("study study.toml -o out --jobs 1"));
}

TEST_F(Status, OfAKilledStudyIsInterruptedAtOnceHoweverLatelyItTold) {
  write("shell.toml", long_scene());
  start({"study", "study.toml", "-o", "out", "--jobs", "1"});
  wait_until([this] {
    const auto found = store::statuses_in(folder() / "out");
    return !found.empty() && found.front().alive && found.front().members.value("runs_running", 0) == 1;
  });
  EXPECT_EQ(status_of({"out"}, 0)["state"], "running");
  send(SIGKILL);
  wait();
  const auto status = status_of({"out"}, 75);
  EXPECT_EQ(status["state"], "interrupted");
  EXPECT_TRUE(status["command"].get<std::string>().ends_with("study study.toml -o out --jobs 1"));
}

TEST_F(Status, KnowsShardsInOneFolderAndInSeveralAndTheirMerge) {
  for (const std::string shard : {"1/2", "2/2"}) {
    ASSERT_EQ(run({"study", "study.toml", "-o", "out", "--shard", shard}).code, 0);
    ASSERT_EQ(run({"study", "study.toml", "-o", "own-" + shard.substr(0, 1), "--shard", shard}).code, 0);
    if (shard == "1/2") {
      EXPECT_EQ(status_of({"out"}, 0)["shards_not_seen"], 1);
    }
  }
  for (const auto& folders : {std::vector<std::string>{"out"}, {"own-1", "own-2"}}) {
    const auto status = status_of(folders, 0);
    EXPECT_EQ(status["state"], "finished");
    EXPECT_EQ(status["cases_done"], 24);
    EXPECT_EQ(status["writers"].size(), 2u);
  }
  ASSERT_EQ(run({"merge", "study.toml", "-o", "out"}).code, 0);
  const auto merged = status_of({"out"}, 0);
  EXPECT_EQ(merged["writers"].size(), 1u);
  EXPECT_EQ(merged["cases_done"], 24);
}

}  // namespace
}  // namespace launchsafe::app
