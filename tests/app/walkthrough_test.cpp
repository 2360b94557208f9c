// The walkthroughs of studies/walkthroughs and the page for Python: every command and every block of Python
// is run, and prints what the page says (stored_page.hpp). With LAUNCHSAFE_ROOT, a folder with a system where
// launchsafe is installed, the pages are those of that system, and their commands run there, by a user who
// may write nowhere else (tests/app/deb.sh).
#include "program.hpp"
#include "stored_page.hpp"

#include <algorithm>
#include <cstdlib>

namespace launchsafe::app {
namespace {

/// A page with every output replaced by what the command above it prints; `python_output_of` is given a block
/// of Python, whose output is the next block of text.
std::string with_outputs(const std::string& page,
                         const std::function<std::string(const std::string&)>& output_of,
                         const std::function<std::string(const std::string&)>& python_output_of) {
  std::istringstream lines(page);
  std::string text, fence, python;
  for (std::string line; std::getline(lines, line);) {
    const bool is_fence = line.starts_with("```");
    if (is_fence) fence = fence.empty() ? line : "";
    const bool is_output = fence == "```console" || fence == "```text";
    if (is_fence || !is_output) {
      text += line + "\n";
      if (!is_fence && fence == "```python") python += line + "\n";
      if (is_fence && fence == "```text") text += python_output_of(std::exchange(python, {}));
    } else if (fence == "```console" && line.starts_with("$ ")) {
      text += line + "\n" + output_of(line.substr(2));
    }
  }
  return text;
}

class Walkthrough : public Program, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (const char* root = std::getenv("LAUNCHSAFE_ROOT")) {
      root_ = root;
      std::filesystem::permissions(folder(), std::filesystem::perms::all);
      ASSERT_EQ(output_of(copy_of_installed), "");
      EXPECT_NE(Program::read("studies/walkthroughs/README.md").find(copy_of_installed), std::string::npos);
      return;
    }
    const std::filesystem::path source = LAUNCHSAFE_SOURCE_DIR;
    for (const char* shared : {"studies", "reports"})
      std::filesystem::create_directory_symlink(source / shared, folder() / shared);
    std::filesystem::create_directory(folder() / "bin");
    std::filesystem::create_symlink(LAUNCHSAFE_PROGRAM, folder() / "bin" / "launchsafe");
  }

  /// What a command prints, on both streams, in the one folder of the page.
  std::string output_of(const std::string& command) {
    write("command.sh", command + "\n");
    const std::string here = "'" + folder().string() + "'";
    const std::string call = root_.empty()
                                 ? "cd " + here + R"( && PATH="$PWD/bin:$PATH" bash command.sh)"
                                 : "chroot --userspec=1000:1000 '" + root_.string() +
                                       "' env -i PATH=/usr/bin:/bin bash -c 'cd /" +
                                       folder().lexically_relative(root_).string() + " && bash command.sh'";
    [[maybe_unused]] const int code = std::system((call + " > " + here + "/output 2>&1").c_str());
    std::string text = Program::read("output");
    if (!text.empty() && text.back() != '\n') text += '\n';
    return text;
  }

  /// What a block of Python adds to the output of those before it, whose names it may use.
  std::string python_output_of(const std::string& block) {
    python_ += block;
    write("page.py", python_);
    const std::string text = output_of("python3 page.py");
    EXPECT_EQ(text.find("Traceback"), std::string::npos) << text;
    const std::size_t before = std::exchange(printed_, text.size());
    return text.substr(std::min(before, text.size()));
  }

  /// Whether a Python that reads the files is there, as `python3` from now on.
  bool finds_python() {
    for (const char* python : {"python3", "/usr/bin/python3"}) {
      const std::string path = output_of(std::string("command -v ") + python);
      if (path.empty()) continue;
      const std::filesystem::path link = folder() / "bin" / "python3";
      std::filesystem::remove(link);
      std::filesystem::create_symlink(path.substr(0, path.find('\n')), link);
      if (output_of("python3 -c 'import h5py, pandas' && echo found") == "found\n") return true;
      std::filesystem::remove(link);
    }
    return false;
  }

 private:
  /// How the pages' folder tells to begin after an installation.
  static constexpr const char* copy_of_installed =
      "cp -r /usr/share/launchsafe/studies /usr/share/launchsafe/reports .";
  std::filesystem::path root_;
  std::string python_;
  std::size_t printed_ = 0;
};

TEST_P(Walkthrough, PrintsWhatThePageSays) {
  const std::filesystem::path file = folder() / "studies" / GetParam();
  std::ifstream stream(file);
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_FALSE(page.empty()) << file;
  if (page.find("```python") != std::string::npos && !finds_python())
    GTEST_SKIP() << "no Python with h5py and pandas (Debian: python3-h5py, python3-pandas)";
  const std::string run = with_outputs(
      page, [this](const std::string& command) { return output_of(command); },
      [this](const std::string& block) { return python_output_of(block); });
  testing::expect_stored(run, file);
}

/// The walkthroughs in their folder, from that of the studies.
std::vector<std::string> walkthroughs() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) /
                                                               "studies" / "walkthroughs"))
    if (entry.path().extension() == ".md" && entry.path().stem() != "README")
      names.push_back("walkthroughs/" + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string name_of(const ::testing::TestParamInfo<std::string>& page) {
  return std::filesystem::path(page.param).stem();
}

INSTANTIATE_TEST_SUITE_P(Pages, Walkthrough, ::testing::ValuesIn(walkthroughs()), name_of);
INSTANTIATE_TEST_SUITE_P(Python, Walkthrough, ::testing::Values("python.md"), name_of);

}  // namespace
}  // namespace launchsafe::app
