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

TEST(ReadAccuracy, AVariantIsTheStudyWithWhatItSaysOtherwise) {
  const StudyFile study =
      study_of(accuracy_start + meshes +
               "title = \"all\"\n[set]\nload.peak = \"400 MPa\"\n"
               "numerics.time_step_factor = 0.5\n[[settings]]\nnumerics.inertial_scaling = 4\n"
               "[[variant]]\nname = \"a\"\n"
               "[[variant]]\nname = \"b_0.1\"\ntitle = \"second\"\n"
               "reference_cell_sizes = \"0.834, 1.25, 2.5 mm\"\n"
               "set = { load.peak = \"300 MPa\" }\n"
               "[[variant.settings]]\nnumerics.cell_size = \"5 mm\"\n");
  const auto& variants = kinds::settings_of<AccuracySettings>(study.study).variants;
  ASSERT_EQ(variants.size(), 2u);
  const scene::Scene &first = variants[0].study.scene.scene, &second = variants[1].study.scene.scene;
  EXPECT_EQ(first.load.peak, 400e6);
  EXPECT_EQ(second.load.peak, 300e6);
  EXPECT_EQ(second.numerics.time_step_factor, 0.5) << "of [set] for all";
  EXPECT_EQ(study.scene.scene.load.peak, 400e6) << "the first is the study's own";
  EXPECT_EQ(variants[0].study.study.title, "all");
  EXPECT_EQ(variants[1].study.study.title, "second");
  std::vector<std::string> labels;
  for (const StudyCase& each : study.cases) labels.push_back(each.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"a: cell_size 0.417 mm", "a: cell_size 0.625 mm",
                                              "a: cell_size 1.25 mm", "a: inertial_scaling 4",
                                              "b_0.1: cell_size 0.834 mm", "b_0.1: cell_size 1.25 mm",
                                              "b_0.1: cell_size 2.5 mm", "b_0.1: cell_size 5 mm"}));
}

TEST(ReadAccuracy, RefusesVariantsThatCannotBeToldApartOrMeanNothing) {
  const auto refuse = [](const std::string& variants, const ExpectedError& expected) {
    expect_error_in(accuracy_start + meshes + variants, expected);
  };
  refuse("[[variant]]\ntitle = \"a\"\n", {4, "variant.name", ""});
  refuse("[[variant]]\nname = \"a\"\n[[variant]]\nname = \"a\"\n", {7, "variant.name", ""});
  refuse("[[variant]]\nname = \"a\"\nkind = \"sweep\"\n", {6, "variant.kind", "sweep"});
  // Faults within are named as in a study, at their line.
  refuse("[[variant]]\nname = \"a\"\nset = { load.peek = \"1 GPa\" }\n",
         {6, "set.load.peek", "", "", "load.peak"});
}

}  // namespace
