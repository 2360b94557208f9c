// The shipped tables, computed for real: the small one, the large one in another form, and a copy.
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

StabilityResult result_of(const scene::Expected<StudyFile>& study) {
  EXPECT_TRUE(study) << study.error().message();
  StudyOptions options;
  options.jobs = 2;
  return study ? run_stability(*study, options) : StabilityResult{};
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The parts of a text between separators that belong, each with its separator before it.
template <class Belongs>
std::string parts_of(const std::string& text, const std::string& separator, Belongs belongs) {
  std::string result = text.substr(0, text.find(separator));
  for (auto begin = text.find(separator); begin < text.size();) {
    const auto end = std::min(text.find(separator, begin + 1), text.size());
    const std::string part = text.substr(begin, end - begin);
    if (belongs(part)) result += part;
    begin = end;
  }
  return result;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool is_case(const std::string& line) { return line.starts_with("\n  { name"); }

TEST(StabilityMatrix, HasNoCaseThatIsWrongOrUnexpected) {
  const StabilityResult result = result_of(read_study(studies_folder / "stability" / "smoke.toml"));
  for (const StressCaseRow& row : result.rows)
    EXPECT_TRUE(row.is_as_expected()) << row.asked.label() << ": " << to_string(row.finding.outcome) << ", "
                                      << row.finding.text << row.answer.failure;
  for (const auto outcome : {Outcome::held, Outcome::degraded, Outcome::caught})
    EXPECT_GT(result.count(outcome), 0u) << to_string(outcome);
}

/// What studies/README.md says to do for a shell of one's own, with the cheapest shell and the cases of load.
TEST(StabilityMatrix, CopiedForAnotherShellItComputesThatShell) {
  std::string text = parts_of(text_of(studies_folder / "stability.toml"), "\n[[group]]",
                              [](const std::string& group) { return has(group, "name = \"load\""); });
  text = parts_of(text, "\n", [](const std::string& line) {
    return !is_case(line) || has(line, "peak 1") || has(line, "negative");
  });
  const StabilityResult result =
      result_of(parse_study(replaced(text, "stability/small_shell.toml", "stability/thin_shell.toml"),
                            studies_folder / "own.toml"));
  ASSERT_EQ(result.rows.size(), 5u);
  const std::vector<std::string> names{"peak 10 MPa", "peak 100 MPa", "peak 1 GPa", "negative pressure",
                                       "peak 11 GPa"};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(result.rows[i].asked.name, names[i]);
    EXPECT_TRUE(result.rows[i].is_as_expected()) << result.rows[i].finding.text;
    if (i < 3) {
      EXPECT_EQ(result.rows[i].answer.run.particles, 24u);
    }
  }
}

class StabilityMatrixSlow : public launchsafe::testing::TemporaryFolder {};

/// The paper's method on its even grid: all cases but those that ask where the other step is stable, and
/// those of the reader. That form computes faces that are bonded for good, and no ignitions.
TEST_F(StabilityMatrixSlow, HasNoCaseThatIsWrongInTheUpdatedLagrangianForm) {
  const auto bonded = folder() / "bonded.toml";
  const std::string smooth = "condition = \"sliding\"\nfriction = 0 ";
  std::ofstream(bonded) << replaced(text_of(studies_folder / "scene_155mm.toml"), smooth,
                                    "condition = \"bonded\" ");
  std::string text = parts_of(text_of(studies_folder / "stability.toml"), "\n[[group]]",
                              [](const std::string& group) { return !has(group, "\nset = { interface"); });
  text = parts_of(text, "\n", [](const std::string& line) {
    return !is_case(line) || (!has(line, "interface") && !has(line, "refused"));
  });
  text = parts_of(text, "\n[[group]]", [](const std::string& group) { return has(group, "\n  { name"); });
  text = replaced(text, "\"scene_155mm.toml\"", '"' + bonded.string() + '"');
  text = replaced(text, "coupling = \"two-way\", kinetics", "kinetics");
  text = replaced(text, "largest_gap = \"0.5 cm\"",
                  "largest_gap = \"0.5 cm\"\nset = { numerics.formulation = \"updated-lagrangian\", "
                  "numerics.growth_x = 1, numerics.growth_r = 1 }");
  const StabilityResult result = result_of(parse_study(text, studies_folder / "stability.toml"));
  for (const StressCaseRow& row : result.rows)
    EXPECT_FALSE(row.is(Outcome::wrong)) << row.asked.label() << ": " << row.finding.text;
  EXPECT_GT(result.count(Outcome::held), result.rows.size() / 3);
}

}  // namespace
