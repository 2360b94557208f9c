// A gnuplot that hangs, lingers or does not stop writing is ended, with all that it started.
#include "launchsafe/report/plot.hpp"
#include "report_folder.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

namespace launchsafe::report {
namespace {

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
    return to_svg(plot, limits, script(body));
  }
  std::filesystem::path path_of(const std::string& name) const { return folder_.path / name; }

 private:
  Folder folder_;
};

TEST_F(DrawingProgram, ThatHangsIsEndedAndSaysSo) {
  const auto svg = drawn_by("exec sleep 3600", {.time = 0.3});
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().kind, store::Error::Kind::failed);
  EXPECT_NE(svg.error().message.find("0.3 s"), std::string::npos) << svg.error().message;
}

TEST_F(DrawingProgram, ThatLeavesAChildWithItsOutputIsNotWaitedFor) {
  const auto svg = drawn_by("sleep 3600 & echo '<svg></svg>'", {.time = 1800.0});
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_EQ(*svg, "<svg></svg>\n");
}

/// Whether a process is at work; one that has ended may wait for its parent.
bool is_alive(const std::string& process) {
  std::ifstream status("/proc/" + process + "/stat");
  std::string number, name, state;
  return status >> number >> name >> state && state != "Z";
}

TEST_F(DrawingProgram, EndsWithItsChildrenWhenTheUserWantsToStop) {
  using namespace std::chrono_literals;
  const std::filesystem::path child = path_of("child"), began = path_of("began");
  std::atomic<bool> stop{false};
  std::thread user([&] {
    while (!std::filesystem::exists(began)) std::this_thread::sleep_for(5ms);
    stop = true;
  });
  const auto svg =
      drawn_by("sleep 3600 & echo $! > " + child.string() + "; touch " + began.string() + "; wait",
               {.time = 1800.0, .stop = &stop});
  user.join();
  ASSERT_FALSE(svg);
  EXPECT_NE(svg.error().message.find("stop"), std::string::npos) << svg.error().message;
  std::string process;
  ASSERT_TRUE(std::ifstream(child) >> process);
  while (is_alive(process)) std::this_thread::sleep_for(5ms);  // one that goes on ends the test by its time
}

}  // namespace
}  // namespace launchsafe::report
