// Random slips in a study whose every key is written: none makes a gap SAFE that was not, unless page one of
// the safety report names the key and what it says now. What the program asks to be accepted is accepted, as
// by somebody who wants his answer. Thirty slips by default; with the label `slow`, three hundred.
#include "launchsafe/run/cost.hpp"
#include "program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <random>

namespace launchsafe::app {
namespace {

constexpr int slips_per_test = 5;
/// Slips that make a launch longer to compute than this, over the usual work, are left out.
constexpr double most_work = 4.0;

/// Two gaps are SAFE; that of 0.0135 cm is not, as the critical gap may be as small as 0.0131 cm.
const std::string study_text = R"(kind = "critical-gap"
scene = "shell.toml"
gaps = "0, 0.01, 0.0135, 0.03, 0.045 cm"
largest_gap = "0.1 cm"
tolerance = "0.0001 cm"
confirm = false
numerical_uncertainty = { value = "5 K", because = "for a test" }
fit_uncertainty = { value = "3 K", because = "for a test" }
input_uncertainty = { value = "5 K", because = "for a test" }
)";

/// The shipped scene with every key written, on few cells and with so much inertia that a launch takes a
/// tenth of a second.
std::vector<std::string> whole_scene() {
  auto scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  scene.numerics.cell_size = 2.5e-3;
  scene.numerics.growth_x = 1.5;
  scene.numerics.inertial_scaling = 16;
  scene.numerics.selective_inertia = 1;
  scene.output.trace_interval = 1e-4;
  scene.output.observation_points.clear();
  std::vector<std::string> lines;
  std::istringstream text(scene::to_toml(scene));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::size_t below(std::size_t end) { return engine_() % end; }

 private:
  std::mt19937_64 engine_;  // whose numbers the standard fixes
};

struct Range {
  std::size_t begin, end;
};

bool is_part_of_number(char letter) {
  return std::isdigit(static_cast<unsigned char>(letter)) != 0 || letter == '.';
}

/// The numbers of a line behind its key, without what belongs to a name.
std::vector<Range> numbers_in(const std::string& line) {
  std::vector<Range> numbers;
  for (std::size_t at = line.find('=') + 1; at < line.size(); ++at) {
    if (!std::isdigit(static_cast<unsigned char>(line[at]))) continue;
    const std::size_t begin = at;
    while (at < line.size() && is_part_of_number(line[at])) ++at;
    if (!std::isalpha(static_cast<unsigned char>(line[begin - 1]))) numbers.push_back({begin, at});
  }
  return numbers;
}

/// What was done to which line.
struct Slip {
  std::string key, text;
};

/// What an acceptance calls what a line says.
std::string accepted_as(const std::string& line) {
  if (line.starts_with("  { name")) return "calibration.shell";
  if (line.starts_with("interface.")) return "calibration.interfaces";
  return line.substr(0, line.find(" = "));
}

/// One slip of a person: a factor of a number, two digits the other way round, or a line that is gone.
Slip slip_of(std::vector<std::string>& lines, Random& random) {
  constexpr std::array factors{10.0, 1000.0, 25.4, 6.895};
  while (true) {
    const std::size_t at = random.below(lines.size());
    std::string& line = lines[at];
    const std::vector<Range> numbers = numbers_in(line);
    const std::string before = line, key = accepted_as(before);
    // Less inertia than the test has is nearer to the launch that the constants are of.
    if (numbers.empty() || key == "numerics.inertial_scaling") continue;
    const std::size_t kind = random.below(10);
    const Range number = numbers[random.below(numbers.size())];
    const std::string digits = line.substr(number.begin, number.end - number.begin);
    if (kind == 0) {
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      return {key, before + "  ->  (dropped)"};
    }
    if (kind < 4) {
      const std::size_t first = number.begin + random.below(digits.size());
      if (first + 1 >= number.end || line[first] == line[first + 1]) continue;
      std::swap(line[first], line[first + 1]);
    } else {
      const double factor = factors[random.below(factors.size())];
      const double value = std::stod(digits);
      if (value == 0.0) continue;
      line.replace(number.begin, digits.size(),
                   fmt::format("{:.6g}", random.below(2) == 0 ? value * factor : value / factor));
    }
    return {key, before + "  ->  " + line};
  }
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Particle updates of a launch; 0 for a scene that is refused.
double work_of(const std::vector<std::string>& lines) {
  const auto scene = scene::parse_scene(text_of(lines), "shell.toml");
  if (!scene) return 0.0;
  EXPECT_NO_THROW(scene::validate(*scene));
  return run::cost_of(scene->scene).work;
}

class EditedStudy : public Program, public ::testing::WithParamInterface<int> {
 protected:
  void write_scene(const std::vector<std::string>& lines, const std::string& acceptances) const {
    write("shell.toml", (acceptances.empty() ? "" : "accept = [\n" + acceptances + "]\n") + text_of(lines));
  }
  /// The gaps that are SAFE, cm.
  std::vector<double> safe_gaps() const {
    std::vector<double> gaps;
    const auto study = nlohmann::json::parse(read("out/study.json"));
    for (const auto& row : study.at("verdicts"))
      if (row.at("verdict") == "SAFE") gaps.push_back(row.at("gap_cm"));
    return gaps;
  }
  void expect_named_on_page_one(const Slip& slip) {
    std::filesystem::remove_all(folder() / "page");
    ASSERT_EQ(run({"report", "out", "-o", "page"}).code, 0);
    std::string page = read("page/report.md");
    page.erase(page.find("## 2."));
    std::erase(page, '\\');
    EXPECT_NE(page.find("Accepted: " + slip.key + " = "), std::string::npos) << slip.text << page;
    std::cout << "safe by its acceptance: " << slip.text << '\n';
  }
  Outcome run_study() {
    std::filesystem::remove_all(folder() / "out");
    return run({"study", "study.toml", "-o", "out"});
  }
};

/// The entries that a study prints for whoever takes responsibility.
std::string acceptances_asked_for(const std::string& out) {
  std::istringstream text(out);
  std::string entries;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("  { key = ")) entries += with(line, "\"...\"", "\"it is meant so\"") + '\n';
  return entries;
}

TEST_P(EditedStudy, IsNotSaferUnlessItsReportNamesTheSlip) {
  const std::vector<std::string> whole = whole_scene();
  write("study.toml", study_text);
  write_scene(whole, "");
  ASSERT_EQ(run_study().code, 4);
  const std::vector<double> before = safe_gaps();
  ASSERT_EQ(before.size(), 2U);
  const double usual_work = work_of(whole);
  Random random(static_cast<unsigned>(GetParam()));
  for (int slips = 0; slips < slips_per_test;) {
    std::vector<std::string> lines = whole;
    const Slip slip = slip_of(lines, random);
    // What only takes long, as a finer mesh does.
    if (work_of(lines) > most_work * usual_work) continue;
    ++slips;
    write_scene(lines, "");
    Outcome outcome = run_study();
    if (const std::string entries = acceptances_asked_for(outcome.out);
        outcome.code == 4 && !entries.empty()) {
      write_scene(lines, entries);
      outcome = run_study();
    }
    if (outcome.code == 2) continue;  // refused
    ASSERT_TRUE(outcome.code == 0 || outcome.code == 3 || outcome.code == 4) << slip.text << outcome.err;
    if (!std::ranges::includes(before, safe_gaps())) expect_named_on_page_one(slip);
  }
}

INSTANTIATE_TEST_SUITE_P(Few, EditedStudy, ::testing::Range(0, 5));
INSTANTIATE_TEST_SUITE_P(Slow, EditedStudy, ::testing::Range(5, 60));

}  // namespace
}  // namespace launchsafe::app
