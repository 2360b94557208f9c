// A gnuplot that hangs, lingers or does not stop writing is ended, with all that it started.
#include "launchsafe/report/plot.hpp"
#include "report_folder.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace launchsafe::report {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class DrawingProgram : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_.path); }

  std::string script(const std::string& body) const {
    const std::filesystem::path path = folder_.path / "gnuplot";
    std::ofstream(path) << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  /// What becomes of a picture that is left to the script.
  store::Result<std::string> drawn_by(const std::string& body, const DrawingLimits& limits) const {
    Plot plot;
    plot.title = "a line";
    plot.series = {{"line", {0.0, 1.0}, {1.0, 2.0}}};
    return to_svg(plot, script(body), limits);
  }
  std::filesystem::path path_of(const std::string& name) const { return folder_.path / name; }

 private:
  Folder folder_;
};

TEST_F(DrawingProgram, ThatHangsIsEndedWithItsChildrenAndSaysSo) {
  const std::string late = path_of("late").string();
  const auto start = Clock::now();
  const auto svg = drawn_by("(sleep 2; touch " + late + ") & sleep 600", {.time = 0.3});
  EXPECT_LT(Clock::now() - start, 2s);
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().kind, store::Error::Kind::failed);
  EXPECT_NE(svg.error().message.find("not done after 0.3 s"), std::string::npos) << svg.error().message;
  std::this_thread::sleep_until(start + 3s);
  EXPECT_FALSE(std::filesystem::exists(late)) << "its child went on";
}

TEST_F(DrawingProgram, ThatLeavesAChildWithItsOutputIsNotWaitedFor) {
  const auto start = Clock::now();
  const auto svg = drawn_by("sleep 600 & echo '<svg></svg>'", {});
  EXPECT_LT(Clock::now() - start, 20s);
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_EQ(*svg, "<svg></svg>\n");
}

TEST_F(DrawingProgram, ThatWritesWithoutEndIsEnded) {
  for (const std::string where : {"", " >&2"}) {
    const auto svg = drawn_by("exec yes" + where, {});
    ASSERT_FALSE(svg);
    EXPECT_NE(svg.error().message.find("wrote more than 64 MiB"), std::string::npos) << svg.error().message;
  }
}

TEST_F(DrawingProgram, EndsWhenTheUserWantsToStop) {
  std::atomic<bool> stop{false};
  std::thread user([&] {
    std::this_thread::sleep_for(200ms);
    stop = true;
  });
  const auto start = Clock::now();
  const auto svg = drawn_by("sleep 600", {.stop = &stop});
  user.join();
  EXPECT_LT(Clock::now() - start, 2s);
  ASSERT_FALSE(svg);
  EXPECT_NE(svg.error().message.find("stop"), std::string::npos) << svg.error().message;
}

}  // namespace
}  // namespace launchsafe::report
