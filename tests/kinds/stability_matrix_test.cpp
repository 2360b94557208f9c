// The small version of the matrix, computed for real.
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

StabilityResult all_rows_of(const StudyFile& study) {
  StudyOptions options;
  options.jobs = 2;
  StabilityResult result = run_stability(study, options);
  EXPECT_EQ(result.rows.size(), study::settings_of<kinds::StabilitySettings>(study.study).cases.size());
  return result;
}

TEST(StabilityMatrix, HasNoCaseThatIsWrongOrUnexpected) {
  const auto study = read_study(studies_folder / "stability" / "smoke.toml");
  ASSERT_TRUE(study) << study.error().message();
  const StabilityResult result = all_rows_of(*study);
  for (const StressCaseRow& row : result.rows)
    EXPECT_TRUE(row.is_as_expected())
        << row.group << ", " << row.name << ": " << to_string(row.finding.outcome) << ", " << row.finding.text
        << row.failure;
  for (const auto outcome : {Outcome::held, Outcome::degraded, Outcome::caught})
    EXPECT_GT(result.count(outcome), 0u) << to_string(outcome);
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

/// The text without its cases of interfaces: that form computes faces that are bonded for good, and no
/// others.
std::string without_interfaces(const std::string& text) {
  const std::string head = "[[case]]\n";
  std::string result = text.substr(0, text.find(head));
  for (auto begin = text.find(head); begin < text.size();) {
    const auto end = std::min(text.find(head, begin + 1), text.size());
    const std::string one = text.substr(begin, end - begin);
    if (one.find("interface") == std::string::npos) result += one;
    begin = end;
  }
  return result;
}

class StabilityMatrixSlow : public launchsafe::testing::TemporaryFolder {};

/// The paper's method on its even grid: all cases but those that ask where the other step is stable. The
/// shell of 155 mm is bonded, and no case goes through ignition, but for those that are refused for it.
TEST_F(StabilityMatrixSlow, HasNoCaseThatIsWrongInTheUpdatedLagrangianForm) {
  const auto bonded = folder() / "bonded.toml";
  const std::string smooth = "condition = \"sliding\"\nfriction = 0 ";
  std::ofstream(bonded) << replaced(text_of(studies_folder / "scene_155mm.toml"), smooth,
                                    "condition = \"bonded\" ");
  std::string text = without_interfaces(text_of(studies_folder / "stability.toml"));
  text = replaced(text, "\"scene_155mm.toml\"", '"' + bonded.string() + '"');
  text = replaced(text, "coupling = \"two-way\", kinetics", "kinetics");
  text = replaced(text, "largest_gap = \"0.5 cm\"",
                  "largest_gap = \"0.5 cm\"\nset = { numerics.formulation = \"updated-lagrangian\", "
                  "numerics.growth_x = 1, "
                  "numerics.growth_r = 1 }");
  const auto study = parse_study(text, studies_folder / "stability.toml");
  ASSERT_TRUE(study) << study.error().message();
  const StabilityResult result = all_rows_of(*study);
  for (const StressCaseRow& row : result.rows)
    EXPECT_NE(row.finding.outcome, Outcome::wrong)
        << row.group << ", " << row.name << ": " << row.finding.text;
  EXPECT_GT(result.count(Outcome::held), settings_of<StabilitySettings>(study->study).cases.size() / 3);
}

}  // namespace
