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
                                   "[[settings]]\nframe = [\"lab\"]\n");
  std::vector<std::string> labels;
  for (const StudyCase& each : study.cases) labels.push_back(each.label);
  // The scene has 1.25 mm and a factor of 0.65: that case and the scene as it is equal the coarsest mesh.
  EXPECT_EQ(labels, (std::vector<std::string>{"cell_size 0.417 mm", "cell_size 0.625 mm", "cell_size 1.25 mm",
                                              "time_step_factor 0.25, cell_size 1.25 mm",
                                              "time_step_factor 0.25, cell_size 5 mm",
                                              "time_step_factor 0.65, cell_size 5 mm", "frame lab"}));
  EXPECT_EQ(study.cases.back().scene.scene.frame, scene::Frame::lab);
}

TEST(ReadAccuracy, TheSceneAsItIsHasACaseOfItsOwn) {
  const StudyFile study = study_of(accuracy_start + meshes + "[set]\nnumerics.cell_size = \"5 mm\"\n");
  ASSERT_EQ(study.cases.size(), 4u);
  EXPECT_EQ(study.cases.back().label, "as in the scene");
}

TEST(ReadAccuracy, RefusesReferencesThatCannotBeExtrapolated) {
  expect_error_in(accuracy_start + "reference_cell_sizes = \"1.25, 2.5 mm\"\n",
                  {3, "reference_cell_sizes", "2 cell sizes", "at least 3"});
  expect_error_in(accuracy_start, {0, "reference_cell_sizes", "0 cell sizes", "at least 3"});
  // 1 mm does not divide the radius of the charge, 65 mm, on an even grid of 78 cells over 77.5 mm.
  expect_error_in(accuracy_start +
                      "reference_cell_sizes = \"1, 1.25, 2.5 mm\"\n[set]\nnumerics.formulation = "
                      "\"updated-lagrangian\"\nnumerics.growth_x = 1\nnumerics.growth_r = 1\n"
                      "interface.nose.condition = \"bonded\"\ninterface.wall.condition = \"bonded\"\n",
                  {3, "reference_cell_sizes", "65.42 cells", "divide"});
  const std::string even_rows = "[set]\nnumerics.growth_r = 1\n";
  expect_error_in(accuracy_start + "reference_cell_sizes = \"1.25, 2.5, 2.5 mm\"\n",
                  {3, "reference_cell_sizes", "twice", "once"});
  expect_error_in(accuracy_start + "reference_cell_sizes = \"1.25, 1.26, 2.5 mm\"\n" + even_rows,
                  {3, "reference_cell_sizes", "not coarser", "different grids"});
  // 2.5 mm over 7 and over 6: a ratio of 1.17 shows ripple rather than convergence.
  expect_error_in(accuracy_start + "reference_cell_sizes = \"0.3572, 0.4168, 2.5 mm\"\n" + even_rows,
                  {3, "reference_cell_sizes", "less than 1.2 times", "far enough apart"});
}

TEST(ReadAccuracy, RefusesSettingsThatMeanNothing) {
  const auto refuse = [](const std::string& settings, const ExpectedError& expected) {
    expect_error_in(accuracy_start + meshes + settings, expected);
  };
  refuse("[[settings]]\nnumerics.cel_size = \"5 mm\"\n",
         {5, "settings.numerics.cel_size", "unknown", "", "numerics.cell_size"});
  refuse("[[settings]]\nnumerics.cell_size = \"5 kg\"\n", {5, "settings.numerics.cell_size", "5 kg"});
  refuse("[[settings]]\ngap.thickness = \"0.01 cm\"\n", {5, "settings.gap.thickness", "as a setting"});
  refuse("[settings]\nnumerics.cell_size = \"5 mm\"\n", {4, "settings", "a table", "[[settings]]"});
  expect_error_in(critical_kind + meshes, {3, "reference_cell_sizes", "kind \"accuracy\""});
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
  refuse("[[variant]]\ntitle = \"a\"\n", {4, "variant.name", "no name", "letters"});
  refuse("[[variant]]\nname = \"a/b\"\n", {5, "variant.name", "a/b", "letters"});
  refuse("[[variant]]\nname = \"a\"\n[[variant]]\nname = \"a\"\n",
         {7, "variant.name", "a second time", "no other"});
  refuse("[[variant]]\nname = \"a\"\nkind = \"sweep\"\n", {6, "variant.kind", "sweep", "otherwise"});
  refuse("[[variant]]\nname = \"a\"\n[[variant.variant]]\nname = \"b\"\n",
         {6, "variant.variant", "", "otherwise"});
  refuse("variant = []\n", {4, "variant", "", "[[variant]]"});
  // Faults within are named as in a study, at their line.
  refuse("[[variant]]\nname = \"a\"\nset = { load.peek = \"1 GPa\" }\n",
         {6, "set.load.peek", "unknown", "", "load.peak"});
  refuse("[[variant]]\nname = \"a\"\n[[variant.settings]]\nnumerics.cell_size = \"5 kg\"\n",
         {7, "settings.numerics.cell_size", "5 kg"});
  refuse("[[variant]]\nname = \"a\"\naccuracy = \"x.json\"\n", {6, "accuracy", "a key of kind"});
}

}  // namespace
