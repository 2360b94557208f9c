// A study that is killed at any instant goes on where it was, and comes to the same.
#include "stored_study.hpp"

#include <algorithm>
#include <random>

namespace launchsafe::app {
namespace {

class KilledStudy : public StoredStudy {
 protected:
  void SetUp() override {
    StoredStudy::SetUp();
    write("shell.toml", brief_scene());
  }

  std::vector<std::string> command(const std::string& output) const {
    return {"study", "study.toml", "-o", output, "--jobs", "2"};
  }

  /// Starts the study and kills it a moment after `reached`; whether it was killed rather than complete.
  bool kill_after(const std::function<bool()>& reached) {
    start(command("out"));
    bool ended = false;
    while (!ended && !reached()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ended = has_ended();
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random_() % 50'000));
    send(SIGKILL);
    const Outcome outcome = wait();
    EXPECT_TRUE(outcome.code == -1 || outcome.code == 0) << outcome.err;
    return outcome.code == -1;
  }

  using Times = std::map<std::string, std::filesystem::file_time_type>;

  /// No file is half there, no case that was done is lost or was computed twice; what has a record has a
  /// file.
  void expect_sound(Times& files_before) {
    EXPECT_EQ(whole_cases("out").size(), case_files("out").size());
    const Times files = case_files("out");
    for (const auto& [hash, time] : files_before)
      EXPECT_TRUE(files.contains(hash) && files.at(hash) == time) << hash;
    for (const std::string& hash : done_cases("out")) EXPECT_TRUE(files.contains(hash)) << hash;
    files_before = files;
  }

  std::mt19937 random_{20261121};
};

TEST_F(KilledStudy, TwentyTimesAndMoreComesToTheSameAsOneThatWasLeftAlone) {
  constexpr int least_kills = 20;
  constexpr std::size_t cases = 12;
  const Outcome undisturbed = run(command("alone"));
  ASSERT_EQ(undisturbed.code, 0) << undisturbed.err;
  Times done;
  bool was_half_done = false, is_complete = false;
  for (int kills = 0; kills < least_kills || !is_complete;) {
    if (is_complete) {
      std::filesystem::remove_all(folder() / "out");
      done.clear();
    }
    // At any instant of its start, or when it has come a case further.
    const std::size_t enough = kills % 3 == 0 ? 0 : done.size() + 1;
    is_complete = !kill_after([&] { return enough == 0 || case_files("out").size() >= enough; });
    if (exists("out")) expect_sound(done);
    if (is_complete) expect_same_results("alone", "out");
    if (HasFailure()) return;
    kills += is_complete ? 0 : 1;
    was_half_done = was_half_done || (!done.empty() && done.size() < cases);
  }
  EXPECT_TRUE(was_half_done);
  EXPECT_EQ(done.size(), cases);
}

TEST_F(KilledStudy, WhileItsReportIsWrittenHasWholeFilesOnly) {
  write("shell.toml", far_scene());
  ASSERT_EQ(run(command("alone")).code, 0);
  ASSERT_EQ(run(command("out")).code, 0);
  std::filesystem::remove(folder() / "out/report.md");
  ASSERT_EQ(run(command("out")).code, 0);
  const auto expected = results_in("alone");
  for (int attempt = 0; attempt < 10; ++attempt) {
    std::filesystem::remove(folder() / "out/report.md");
    kill_after([] { return true; });
    for (const auto& [name, bytes] : results_in("out")) {
      if (name.front() == '.') continue;
      EXPECT_TRUE(expected.contains(name) && expected.at(name) == bytes) << name;
    }
  }
  EXPECT_EQ(run(command("out")).code, 0);
  expect_same_results("alone", "out");
}

}  // namespace
}  // namespace launchsafe::app
