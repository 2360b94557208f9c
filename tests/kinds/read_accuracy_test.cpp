#include "launchsafe/kinds/accuracy.hpp"
#include "study/read_error.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string accuracy_start = "kind = \"accuracy\"\nscene = \"scene_155mm.toml\"\n";
const std::string meshes = "reference_cell_sizes = \"0.625, 1.25, 0.417 mm\"\n";

TEST(ReadAccuracy, MakesTheReferenceMeshesFinestFirstThenEverySetting) {
  const StudyFile study = study_of(accuracy_start + meshes +
                                   "[[settings]]\nnumerics.time_step_factor = [0.25, 0.65]\n"
                                   "numerics.cell_size = \"1.25, 5 mm\"\n"
                                   "[[settings]]\nfriction.closure = [\"none\"]\n");
  std::vector<std::string> labels;
  for (const StudyCase& each : study.cases) labels.push_back(each.label);
  // The scene has 1.25 mm and a factor of 0.65: that case and the scene as it is equal the coarsest mesh.
  EXPECT_EQ(labels, (std::vector<std::string>{"cell_size 0.417 mm", "cell_size 0.625 mm", "cell_size 1.25 mm",
                                              "time_step_factor 0.25, cell_size 1.25 mm",
                                              "time_step_factor 0.25, cell_size 5 mm",
                                              "time_step_factor 0.65, cell_size 5 mm", "closure none"}));
  EXPECT_EQ(study.cases.back().scene.scene.surface.friction, scene::FrictionClosure::none);
}

TEST(ReadAccuracy, TheSceneAsItIsHasACaseOfItsOwn) {
  const StudyFile study = study_of(accuracy_start + meshes + "[set]\nnumerics.cell_size = \"5 mm\"\n");
  ASSERT_EQ(study.cases.size(), 4u);
  EXPECT_EQ(study.cases.back().label, "as in the scene");
}

TEST(ReadAccuracy, RefusesReferencesThatCannotBeExtrapolated) {
  expect_error_in(accuracy_start + "reference_cell_sizes = \"1.25, 2.5 mm\"\n",
                  {3, "reference_cell_sizes", "2", "3"});
  expect_error_in(accuracy_start, {0, "reference_cell_sizes", "0", "3"});
  const std::string even_rows = "[set]\nnumerics.growth_r = 1\n";
  expect_error_in(accuracy_start + "reference_cell_sizes = \"1.25, 1.26, 2.5 mm\"\n" + even_rows,
                  {3, "reference_cell_sizes", ""});
  // 2.5 mm over 7 and over 6: a ratio of 1.17 shows ripple rather than convergence.
  expect_error_in(accuracy_start + "reference_cell_sizes = \"0.3572, 0.4168, 2.5 mm\"\n" + even_rows,
                  {3, "reference_cell_sizes", "1.2"});
}

TEST(ReadAccuracy, RefusesSettingsThatMeanNothing) {
  const auto refuse = [](const std::string& settings, const ExpectedError& expected) {
    expect_error_in(accuracy_start + meshes + settings, expected);
  };
  refuse("[[settings]]\nnumerics.cel_size = \"5 mm\"\n",
         {5, "settings.numerics.cel_size", "", "", "numerics.cell_size"});
  refuse("[[settings]]\nnumerics.cell_size = \"5 kg\"\n", {5, "settings.numerics.cell_size", "5 kg"});
  refuse("[[settings]]\ngap.thickness = \"0.01 cm\"\n", {5, "settings.gap.thickness", ""});
}

}  // namespace
