// From a gauge's record to verdicts on a shell of one's own: three commands, each printed by the one before.
#include "program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace launchsafe::app {
namespace {

class OwnShell : public Program {
 protected:
  /// A record with an offset of 5 bar, and noise (bar) that is below zero before the launch.
  void SetUp() override {
    Program::SetUp();
    constexpr double noise = 0.5;
    std::string record = "Time (ms);P breech (bar)\n";
    for (int i = 0; i <= 260; ++i) {
      const double time = -2.0 + 0.05 * i, since = std::max(0.0, time - 0.5) / 4.0;
      record += fmt::format(
          "{:.2f};{:.2f}\n", time,
          3800.0 * std::pow(since * std::exp(1.0 - since), 3.0) + 5.0 + noise * ((i * 7) % 5 - 2));
    }
    write("gauge.csv", record);
  }

  /// The words of the command that an output ends with.
  static std::vector<std::string> next_of(const std::string& out) {
    const auto at = out.rfind("next: launchsafe ");
    EXPECT_NE(at, std::string::npos) << out;
    std::istringstream words(out.substr(at + 17, out.find('\n', at) - at - 17));
    std::vector<std::string> list;
    for (std::string word; words >> word;) {
      if (word.front() == '\'') {
        std::string rest;
        std::getline(words, rest, '\'');
        word = word.substr(1) + rest;
      }
      list.push_back(word);
    }
    return list;
  }
};

TEST_F(OwnShell, IsThreeCommandsAwayFromARecord) {
  const Outcome imported = run({"import-curve", "gauge.csv", "-o", "pressure.csv"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.out.find("offset   0.5 MPa"), std::string::npos) << imported.out;
  const std::vector<std::string> init = next_of(imported.out);
  ASSERT_EQ(init.front(), "init");
  const Outcome started = run(init);
  ASSERT_EQ(started.code, 0) << started.err;
  std::vector<std::string> study = next_of(started.out);
  ASSERT_EQ(study.front(), "study");
  study.push_back("--dry-run");
  const Outcome planned = run(study);
  EXPECT_EQ(planned.code, 0) << planned.err;
}

/// What the program prints for whoever takes responsibility, with a reason in place of each "...".
std::string acceptances_in(const std::string& out) {
  std::istringstream text(out);
  std::string lines;
  for (std::string line; std::getline(text, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line.starts_with("[accept")) lines += line + '\n';
    if (line.ends_with(" = \"...\"")) lines += with(line, "...", "our own trials agree") + '\n';
  }
  return lines;
}

/// A shell of 105 mm and a record, nothing else: no verdict SAFE until what is extrapolated is accepted.
TEST_F(OwnShell, HasBoundsAtOnceAndEveryVerdictOnceTheExtrapolationIsAccepted) {
  std::string record = "time_ms,pressure_MPa\n";
  for (int i = 0; i <= 400; ++i) {
    const double since = 0.05 * i / 2.2;
    record += fmt::format("{:.2f},{:.4f}\n", 0.05 * i, 380.0 * std::pow(since * std::exp(1.0 - since), 3.0));
  }
  write("pulse.csv", record);
  ASSERT_EQ(run({"init", "--calibre", "105 mm", "--curve", "pulse.csv", "-o", "shell"}).code, 0);
  const std::string file = "shell/critical_gap.toml";
  write(file, with(read(file), "gaps = ", "confirm = false\ngaps = "));
  const auto verdicts = [&](const std::string& verdict) {
    const auto study = nlohmann::json::parse(read("out/study.json"));
    return std::ranges::count_if(study["verdicts"],
                                 [&](const auto& row) { return row["verdict"] == verdict; });
  };
  const Outcome first = run({"study", file, "-o", "out"});
  ASSERT_EQ(first.code, 0) << first.err;
  const auto gap = nlohmann::json::parse(read("out/study.json"))["critical_gap"];
  EXPECT_EQ(gap["basis"], "extrapolated");
  EXPECT_LT(gap["critical_gap_at_least_cm"].get<double>(), gap["critical_gap_cm"].get<double>());
  EXPECT_GT(gap["critical_gap_at_most_cm"].get<double>(), gap["critical_gap_cm"].get<double>());
  EXPECT_EQ(verdicts("SAFE"), 0);
  const std::string accepted = acceptances_in(first.out);
  EXPECT_NE(accepted.find("calibre = "), std::string::npos) << first.out;
  write(file, read(file) + accepted);
  const Outcome second = run({"study", file, "-o", "out", "--update"});
  ASSERT_EQ(second.code, 0) << second.err;
  for (const char* verdict : {"SAFE", "INDETERMINATE", "UNSAFE"}) EXPECT_GT(verdicts(verdict), 0) << verdict;
}

TEST_F(OwnShell, IsNotInitialisedFromWhatIsNoLaunch) {
  write("seconds.csv", "time_s,pressure_MPa\n0,0\n1,100\n2,400\n3,0\n");
  write("pascals.csv", "time_ms,pressure_Pa\n0,0\n4,400\n12,0\n");
  write("zeros.csv", "time_ms,pressure_MPa\n0,0\n4,0\n12,0\n");
  for (const std::vector<std::string>& launch :
       std::vector<std::vector<std::string>>{{"--curve", "seconds.csv"},
                                             {"--curve", "pascals.csv"},
                                             {"--curve", "zeros.csv"},
                                             {"--peak", "1 Pa"}}) {
    const Outcome refused = run({"init", "--calibre", "105 mm", launch[0], launch[1], "-o", "shell"});
    EXPECT_EQ(refused.code, 2) << launch[1] << refused.err;
    EXPECT_EQ(refused.lines_of_error(), 1) << refused.err;
    EXPECT_TRUE(refused.says(launch[0] == "--curve" ? launch[1] + ":" : "--peak: ")) << refused.err;
    EXPECT_FALSE(exists("shell"));
  }
}

TEST_F(OwnShell, OverwritesNothingAndRefusesSenselessWishes) {
  EXPECT_EQ(run({"init", "--calibre", "105 mm", "-o", "shell"}).code, 0);
  EXPECT_EQ(run({"init", "--calibre", "105 mm", "-o", "shell"}).code, 0);
  write("shell/scene.toml", "mine");
  EXPECT_EQ(run({"init", "--calibre", "105 mm", "-o", "shell"}).code, 2);
  EXPECT_EQ(read("shell/scene.toml"), "mine");
  EXPECT_EQ(run({"init", "--calibre", "2 m", "-o", "other"}).code, 2);
  EXPECT_EQ(run({"init", "--calibre", "105", "-o", "other"}).code, 2);
  EXPECT_EQ(
      run({"init", "--calibre", "105 mm", "--curve", "gauge.csv", "--peak", "3 MPa", "-o", "other"}).code, 2);
  EXPECT_EQ(run({"import-curve", "absent.csv"}).code, 2);
  EXPECT_EQ(run({"import-curve", "gauge.csv", "-o", "curve.txt"}).code, 2);
  EXPECT_EQ(run({"import-curve", "gauge.csv", "--trigger", "-3 MPa"}).code, 2);
  EXPECT_EQ(run({"import-curve", "gauge.csv", "--offset", "20 MPa", "-o", "other.csv"}).code, 2);
  EXPECT_FALSE(exists("other.csv"));
  write("pressure.csv", "mine");
  EXPECT_EQ(run({"import-curve", "gauge.csv", "-o", "pressure.csv"}).code, 2);
  EXPECT_EQ(read("pressure.csv"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder() / "other"));
}

}  // namespace
}  // namespace launchsafe::app
