// The walkthroughs of studies/walkthroughs: every command is run, and prints what the page says. With
// LAUNCHSAFE_WALKTHROUGHS=write in the environment the pages are written anew instead.
#include "program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace launchsafe::app {
namespace {

const std::filesystem::path pages = std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) / "studies" / "walkthroughs";

/// A page with every command's output replaced by what `output_of` gives.
std::string with_outputs(const std::string& page,
                         const std::function<std::string(const std::string&)>& output_of) {
  std::istringstream lines(page);
  std::string text;
  bool in_console = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_fence = line.starts_with("```");
    if (is_fence) in_console = line == "```console";
    if (!in_console || is_fence) {
      text += line + "\n";
    } else if (line.starts_with("$ ")) {
      text += line + "\n" + output_of(line.substr(2));
    }
  }
  return text;
}

/// Words of a text, with every number by itself; what only draws a table's columns is left out.
std::vector<std::string> words_of(const std::string& text) {
  static const std::regex word(R"([-+]?\d+\.?\d*(?:e[-+]?\d+)?|[^\s\d]+)");
  std::vector<std::string> words;
  for (std::sregex_iterator each(text.begin(), text.end(), word), end; each != end; ++each)
    if (each->str().find_first_not_of('-') != std::string::npos) words.push_back(each->str());
  return words;
}

/// Numbers may differ by a hundredth between processors, words not at all.
bool agrees(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char *end_a = nullptr, *end_b = nullptr;
  const double first = std::strtod(a.c_str(), &end_a), second = std::strtod(b.c_str(), &end_b);
  if (*end_a != '\0' || *end_b != '\0') return false;
  return std::abs(first - second) <= 0.01 * std::max(std::abs(first), std::abs(second));
}

class Walkthrough : public Program, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    Program::SetUp();
    const std::filesystem::path source = LAUNCHSAFE_SOURCE_DIR;
    for (const char* shared : {"studies", "reports"})
      std::filesystem::create_directory_symlink(source / shared, folder() / shared);
    std::filesystem::create_directory(folder() / "bin");
    std::filesystem::create_symlink(LAUNCHSAFE_PROGRAM, folder() / "bin" / "launchsafe");
  }

  /// What a command prints, on both streams, in the one folder of the page.
  std::string output_of(const std::string& command) {
    write("command.sh", command + "\n");
    const std::string call =
        "cd '" + folder().string() + "' && PATH=\"$PWD/bin:$PATH\" bash command.sh > output 2>&1";
    [[maybe_unused]] const int code = std::system(call.c_str());
    std::string text = Program::read("output");
    if (!text.empty() && text.back() != '\n') text += '\n';
    return text;
  }
};

TEST_P(Walkthrough, PrintsWhatThePageSays) {
  const std::filesystem::path file = pages / GetParam();
  std::ifstream stream(file);
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_FALSE(page.empty()) << file;
  const std::string run =
      with_outputs(page, [this](const std::string& command) { return output_of(command); });
  if (std::getenv("LAUNCHSAFE_WALKTHROUGHS") != nullptr) {
    std::ofstream(file) << run;
    return;
  }
  const std::vector<std::string> expected = words_of(page), found = words_of(run);
  ASSERT_EQ(expected.size(), found.size()) << run;
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_TRUE(agrees(expected[i], found[i])) << expected[i] << " is " << found[i] << " in\n" << run;
}

INSTANTIATE_TEST_SUITE_P(Pages, Walkthrough,
                         ::testing::Values("own_shell.md", "overnight_sweep.md", "reading_accuracy.md"),
                         [](const auto& page) {
                           std::string name = page.param;
                           name.resize(name.find('.'));
                           return name;
                         });

}  // namespace
}  // namespace launchsafe::app
