// The real program, started as a user would, with its output in files.
#pragma once

#include "small_shell.hpp"
#include "store/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace launchsafe::app {

/// A small shell whose run takes milliseconds. Its load is over, below 1 % of its peak, at 0.137 ms.
inline const std::string tiny_scene = R"(title = "a small shell"
constants = "none"
[load]
duration = "0.15 ms"
base = "0 Pa"
peak = "50 MPa"
peak_time = "0.035 ms"
exponent = 3
shape = "power-exponential"
[gap]
thickness = "0, 0.01 cm"

[numerics]
cell_size = "5 mm"
energy_drift_limit = 0.5

[output]
trace_interval = "5 us"

[station]
width = "1.5 cm"
depth = "1 cm"

[interface]
cup.condition = "bonded"
wall.condition = "bonded"
base.condition = "bonded"
)" + testing::small_shell + testing::small_shell_base +
                                      testing::small_shell_point;

/// The text with its first `from` replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A file of studies/.
inline std::string shipped(const std::string& name) {
  std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The same shell under five times the pressure and ten times as long, over twelve calibres of travel: under
/// shorter ones nothing is safe.
inline std::string far_scene() {
  return with(with(with(with(tiny_scene, "0.15 ms", "1.5 ms"), "0.035 ms", "0.35 ms"), "50 MPa", "250 MPa"),
              "\"5 us\"", "\"50 us\"");
}

/// A launch that takes a tenth of a second or two.
inline std::string brief_scene() { return with(far_scene(), "\"5 mm\"", "\"2 mm\""); }

/// A launch that takes minutes: no test waits for its end.
inline std::string long_scene() {
  return with(with(tiny_scene, "0.15 ms", "500 ms"), "\"5 mm\"", "\"0.5 mm\"");
}

/// How the program ended.
struct Outcome {
  int code = -1;  ///< of its exit; -1 when a signal ended it
  std::string out, err;

  int lines_of_error() const {
    int lines = 0;
    for (const char letter : err) lines += letter == '\n' ? 1 : 0;
    return lines;
  }
  bool says(const std::string& part) const { return err.find(part) != std::string::npos; }
};

/// Tests in a folder of their own that start the program there.
class Program : public testing::TemporaryFolder {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(folder() / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder() / name); }

  /// What the next children do before they become the program: limits, for example.
  void before_start(std::function<void()> preparation) { preparation_ = std::move(preparation); }

  /// Starts the program with the test's folder as its working directory.
  void start(std::vector<std::string> arguments, int error_descriptor = -1) {
    arguments.insert(arguments.begin(), LAUNCHSAFE_PROGRAM);
    start_program(arguments, error_descriptor);
  }
  /// Starts another program.
  void start_program(std::vector<std::string> arguments, int error_descriptor = -1) {
    child_ = ::fork();
    if (child_ == 0) become(arguments, error_descriptor);
    ASSERT_GT(child_, 0);
  }
  void send(int signal) const { ASSERT_EQ(::kill(child_, signal), 0); }
  pid_t child() const { return child_; }

  /// Waits until something has come about; fails where the program ends before.
  void wait_until(const std::function<bool()>& has_come_about) const {
    using namespace std::chrono_literals;
    for (bool ended = false; !has_come_about(); std::this_thread::sleep_for(5ms)) {
      ASSERT_FALSE(ended) << "the program ended before: " << read("stderr.txt");
      ended = has_ended();
    }
  }
  bool has_ended() const {
    siginfo_t end{};
    return ::waitid(P_PID, static_cast<id_t>(child_), &end, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           end.si_pid == child_;
  }
  void wait_for_file(const std::string& name) const {
    wait_until([&] { return exists(name); });
  }
  /// Waits until the program catches a signal, by the mask of the kernel.
  void wait_until_it_catches(int signal) const {
    wait_until([&] {
      std::ifstream status("/proc/" + std::to_string(child_) + "/status");
      std::string word;
      while (status >> word && word != "SigCgt:") {
      }
      status >> word;
      return status && (std::stoull(word, nullptr, 16) >> (signal - 1) & 1U) != 0;
    });
  }

  Outcome wait() {
    Outcome outcome;
    int status = 0;
    EXPECT_EQ(::waitpid(child_, &status, 0), child_);
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    outcome.out = read(output_file("stdout"));
    outcome.err = read(output_file("stderr"));
    return outcome;
  }

  Outcome run(const std::vector<std::string>& arguments) {
    start(arguments);
    return wait();
  }

  /// A command as a person would type it.
  Outcome run_in_shell(const std::string& command) {
    start_program({"/bin/sh", "-c", command});
    return wait();
  }

  /// Runs the program while another is running.
  Outcome run_beside(const std::vector<std::string>& arguments) {
    const auto child = std::exchange(child_, -1);
    output_mark_ = "_beside";
    const Outcome outcome = run(arguments);
    output_mark_.clear();
    child_ = child;
    return outcome;
  }

 private:
  [[noreturn]] void become(std::vector<std::string>& arguments, int error_descriptor) const {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
    if (::chdir(folder().c_str()) != 0) ::_exit(126);
    if (preparation_) preparation_();
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    ::dup2(::open(output_file("stdout").c_str(), flags, 0600), STDOUT_FILENO);
    const std::string errors = output_file("stderr");
    ::dup2(error_descriptor >= 0 ? error_descriptor : ::open(errors.c_str(), flags, 0600), STDERR_FILENO);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    ::execv(pointers.front(), pointers.data());
    ::_exit(127);
  }

  std::string output_file(const std::string& stream) const { return stream + output_mark_ + ".txt"; }

  pid_t child_ = -1;
  std::string output_mark_;
  std::function<void()> preparation_;
};

}  // namespace launchsafe::app
