// Files that would hang, crash or mislead the program that reads them.
#include "program.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <ostream>

namespace launchsafe::app {
namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

struct HostileFile {
  std::string name;
  std::string text;                  ///< of the file "input.toml"
  std::vector<std::string> message;  ///< what the one message names
  friend void PrintTo(const HostileFile& file, std::ostream* stream) { *stream << file.name; }
};

class HostileFileProgram : public Program, public ::testing::WithParamInterface<HostileFile> {
 protected:
  void SetUp() override {
    Program::SetUp();
    before_start([] {
      const rlimit small{256 << 10, 256 << 10};
      ::setrlimit(RLIMIT_STACK, &small);
    });
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& message) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments.front() << ": " << outcome.err.substr(0, 1000);
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_LT(outcome.err.size(), 6000u);
    for (const std::string& part : message) EXPECT_TRUE(outcome.says(part)) << part << " in " << outcome.err;
    EXPECT_FALSE(exists("out"));
  }
};

TEST_P(HostileFileProgram, IsRefusedWithOneShortMessageAlsoOnASmallStack) {
  write("input.toml", GetParam().text);
  expect_refused({"run", "input.toml", "-o", "out"}, GetParam().message);
  expect_refused({"study", "input.toml", "-o", "out"}, GetParam().message);
  expect_refused({"explain", "input.toml"}, GetParam().message);
}

constexpr std::size_t deep = 100'000;

INSTANTIATE_TEST_SUITE_P(
    Files, HostileFileProgram,
    ::testing::Values(HostileFile{"NestedArrays",
                                  "a = " + repeated("[", deep) + repeated("]", deep),
                                  {"nested value depth of 16"}},
                      HostileFile{"DottedKey", repeated("a.", deep) + "b = 1", {"200 points"}},
                      HostileFile{"Binary",
                                  std::string("\x7f"
                                              "ELF\0\0\1",
                                              7),
                                  {"text that is not TOML"}},
                      HostileFile{"TooLarge", "#" + std::string(std::size_t{16} << 20, ' '), {"16 MiB"}}),
    [](const auto& test) { return test.param.name; });

TEST_F(HostileFileProgram, WhatIsNoRegularFileIsRefusedAtOnce) {
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder() / "folder");
  for (const auto& [file, kind] : {std::pair<std::string, std::string>{"pipe", "a pipe or a device"},
                                   {"/dev/zero", "a pipe or a device"},
                                   {"folder", "a folder"}}) {
    expect_refused({"run", file, "-o", "out"}, {kind});
    expect_refused({"study", file, "-o", "out"}, {kind});
    expect_refused({"explain", file}, {kind});
    write("scene.toml", with(tiny_scene, "base = \"0 Pa\"\npeak = \"50 MPa\"", "curve = \"" + file + "\""));
    expect_refused({"run", "scene.toml", "-o", "out"}, {kind});
  }
}

// Longer than the names of files may be: that was an internal error, exit code 70.
TEST_F(HostileFileProgram, NamesThatNoFileMayHaveAreRefused) {
  const std::string name(5000, 'a');
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", name},
                                                    {"study", name, "-o", "out"},
                                                    {"explain", name},
                                                    {"status", name},
                                                    {"import-curve", name},
                                                    {"plot", name},
                                                    {"report", name, "-o", "out"}})
    EXPECT_EQ(run(arguments).code, 2) << arguments.front();
}

class CurveProgram : public Program {};

/// A pulse of 20 ms behind 40 ms of silence, in points 1 ms apart, under a header.
std::string sparse_curve(const std::string& header) {
  std::string curve = header + "\n";
  for (int i = -40; i <= 20; ++i)
    curve +=
        fmt::format("{},{}\n", i, i <= 0 ? 0.0 : 50.0 * std::pow(i / 4.0 * std::exp(1.0 - i / 4.0), 3.0));
  return curve;
}

TEST_F(CurveProgram, RefusesARecordInSecondsThatWasMeantInMillisecondsWithOneMessage) {
  write("curve.csv", sparse_curve("time_s,pressure_MPa"));
  write("scene.toml",
        with(tiny_scene, "base = \"0 Pa\"\npeak = \"50 MPa\"\npeak_time = \"0.035 ms\"\nexponent = 3",
             "curve = \"curve.csv\"\n"));
  write("study.toml", "kind = \"critical-gap\"\nscene = \"scene.toml\"\n");
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"import-curve", "curve.csv", "-o", "out.csv"},
                                             {"explain", "scene.toml"},
                                             {"run", "scene.toml", "-o", "out"},
                                             {"study", "study.toml", "-o", "out"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments.front() << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.says("curve.csv:1: time: ")) << outcome.err;
    EXPECT_FALSE(exists("out"));
  }
}

}  // namespace
}  // namespace launchsafe::app
