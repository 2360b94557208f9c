#include "launchsafe/study/record_domain.hpp"

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/accuracy_record.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "scene/perturbed_scenes.hpp"
#include "scene/scene_text.hpp"
#include "study/synthetic_launch.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;
using keys::ActsOn, keys::Part;

constexpr RecordKind kinds[] = {RecordKind::calibration, RecordKind::accuracy};

/// The shipped scene, whose inertia is stated: what a scene takes by default follows from other keys.
const scene::SceneFile& own() {
  static const scene::SceneFile file =
      scene::with_written_key(scene::read_scene(studies_folder / "scene_155mm.toml").value(),
                              "numerics.selective_inertia", "4", {})
          .value();
  return file;
}

bool is_outside(RecordKind kind, const scene::Scene& scene) {
  return !distance_to_record(kind, scene, own().scene).inside();
}

/// Whether a record of accuracy would judge it by its own numbers: as another launch, or another setting.
bool is_told_by_numbers(const scene::Scene& scene) {
  const RecordedLaunch a = launch_of(scene), b = launch_of(own().scene);
  const materials::ViscoScramParameters &cracks = scene.charge().strength,
                                        &own_cracks = own().scene.charge().strength;
  return !same_setting(setting_of(scene), setting_of(own().scene)) || a.peak_pressure != b.peak_pressure ||
         a.duration != b.duration || a.shape != b.shape ||
         cracks.initial_crack_radius != own_cracks.initial_crack_radius ||
         cracks.flaw_size != own_cracks.flaw_size ||
         scene.surface.localisation != own().scene.surface.localisation || a.air_heating != b.air_heating ||
         scene.initial_temperature != own().scene.initial_temperature;
}

/// What a key's role lets a record speak of though the key has another value.
bool may_be_inside(RecordKind kind, const scene::KeyDescription& key, const scene::Scene& scene) {
  const keys::Role role = key.role();
  if (role.part == Part::free) return true;
  if (kind == RecordKind::accuracy)
    return is_told_by_numbers(scene) || role.part == Part::load_shape || role.acts_on == ActsOn::chemistry ||
           (role.acts_on == ActsOn::surface && role.part == Part::range);
  return role.part == Part::minor_setting;
}

double temperature(const scene::Scene& scene) {
  static const StudyFile study = study_of(critical_text + "gaps = \"0.01 cm\"\n");
  StudyCase input = study.cases.front();
  input.scene.scene = scene;
  return answer_of(study.study, input, synthetic_mechanics(own().scene)).verdicts.front().maximum.temperature;
}

/// A key that is new is covered here by itself: without a role it has to lie outside of every record.
TEST(RecordDomain, AnotherValueOfAKeyIsOutsideUnlessItsRoleSaysWhyNot) {
  int compared = 0;
  for (const auto& key : scene::scene_keys()) {
    for (const scene::SceneFile& other : scene::perturbed(own(), key)) {
      if (same_value(key.get(other.scene), key.get(own().scene))) continue;
      ++compared;
      const auto found = differences(other.scene, own().scene);
      EXPECT_TRUE(std::ranges::any_of(found, [&](const auto& each) { return each.key.name == key.name; }))
          << key.name;
      for (const RecordKind kind : kinds)
        EXPECT_TRUE(is_outside(kind, other.scene) || may_be_inside(kind, key, other.scene))
            << key.name << ", kind " << static_cast<int>(kind);
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(RecordDomain, AKeyThatDoesNotReachTheMechanicsOrTheSkinChangesNeither) {
  const std::string part = scene::to_toml(scene::mechanical_part(own().scene));
  for (const auto& key : scene::scene_keys()) {
    const ActsOn acts_on = key.role().acts_on;
    if (keys::reaches_mechanics(acts_on)) continue;
    for (const scene::SceneFile& other : scene::perturbed(own(), key)) {
      EXPECT_EQ(scene::to_toml(scene::mechanical_part(other.scene)), part) << key.name;
      if (acts_on == ActsOn::nothing || acts_on == ActsOn::combustion) {
        EXPECT_EQ(temperature(other.scene), temperature(own().scene)) << key.name;
      }
    }
  }
}

/// Of parts of a scene that its own keys do not speak of; `change` gives each another value of each key.
template <class Owner>
void expect_outside(const std::vector<scene::Key<Owner>>& keys, std::vector<Owner> scene::Scene::*owners) {
  for (const scene::Key<Owner>& key : keys) {
    for (std::size_t i = 0; i < (own().scene.*owners).size(); ++i) {
      for (const scene::Value& value : scene::other_values(key, key.get((own().scene.*owners)[i]))) {
        scene::Scene other = own().scene;
        if (key.name == "material") {
          other.materials.push_back(*scene::find_material(other, other.bodies[i].material));
          other.materials.back().name = std::get<std::string>(value);
        }
        key.set((other.*owners)[i], value);
        for (const RecordKind kind : kinds)
          EXPECT_NE(is_outside(kind, other), key.role().part == Part::free) << key.name << " of " << i;
      }
    }
  }
}

/// A body that is called otherwise takes the interface with it that speaks of it.
TEST(RecordDomain, AnotherValueOfABodyOrAnInterfaceIsOutside) {
  std::vector<scene::Key<scene::Body>> keys = scene::body_keys();
  std::erase_if(keys, [](const auto& key) { return key.name == "name"; });
  expect_outside(keys, &scene::Scene::bodies);
  expect_outside(scene::interface_keys(), &scene::Scene::interfaces);
}

TEST(RecordDomain, ObservationPointsAreComparedAndVoidNothing) {
  scene::Scene other = own().scene;
  other.output.observation_points.front().r += 1e-3;
  const auto found = differences(other, own().scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().key.name, "observation_point");
  for (const RecordKind kind : kinds) EXPECT_FALSE(is_outside(kind, other));
}

}  // namespace
