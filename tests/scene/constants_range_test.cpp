// Where constants hold: the intervals of the shipped ones, one change of their own launch at a time.
#include "launchsafe/materials/laws.hpp"
#include "launchsafe/scene/constants.hpp"
#include "scene/scene_text.hpp"

#include <functional>

namespace {

using namespace launchsafe;
using namespace launchsafe::scene;

const Constants& fitted_launch() { return *shipped_constants().front(); }

using Names = std::vector<std::string>;
using Change = std::function<void(Scene&)>;

Names outside(const Scene& scene, const Constants& constants = fitted_launch()) {
  Names names;
  for (const OutsideOfRange& each : outside_of_range(constants, scene)) names.push_back(each.name);
  return names;
}
Names outside_after(const Change& change) {
  Scene scene = fitted_launch().scene;
  change(scene);
  return outside(scene);
}

/// The shell with other radii (m): all around, and of the charge.
Change with_radii(double outer, double charge) {
  return [=](Scene& scene) {
    for (Body& body : scene.bodies) {
      if (body.name == "wall") body.r_begin = charge;
      body.r_end = body.name == "charge" ? charge : outer;
    }
  };
}
Change with_charge_length(double length) {
  return [=](Scene& scene) {
    for (Body& body : scene.bodies)
      if (body.name == "charge") body.x_end = body.x_begin + length;
  };
}

/// The ends stand in studies/constants/155mm.toml; a share is of the larger of two numbers.
TEST(ConstantsRange, HoldsUpToTheEndsOfEachInterval) {
  const auto peak = [](double value) { return [=](Scene& s) { s.load.peak = value; }; };
  const auto start = [](double value) { return [=](Scene& s) { s.initial_temperature = value; }; };
  const auto cracks = [](double value) {
    return [=](Scene& s) { s.charge().strength.initial_crack_radius = value; };
  };
  const auto flaws = [](double value) { return [=](Scene& s) { s.charge().strength.flaw_size = value; }; };
  const auto steel = [](double factor) { return [=](Scene& s) { s.steel().strength.a *= factor; }; };
  const auto density = [](double factor) { return [=](Scene& s) { s.charge().density *= factor; }; };
  struct Interval {
    const char* name;
    std::vector<Change> inside, outside;
  };
  const std::vector<Interval> intervals{
      {"peak_pressure", {peak(400e6), peak(550e6)}, {peak(399e6), peak(551e6)}},
      {"initial_temperature", {start(219.0), start(345.0)}, {start(218.9), start(345.1)}},
      {"calibre",
       {with_radii(75e-3, 62.5e-3), with_radii(80e-3, 67.5e-3)},
       {with_radii(74.9e-3, 62.4e-3), with_radii(80.1e-3, 67.6e-3)}},
      {"charge_length",
       {with_charge_length(0.504), with_charge_length(0.616)},
       {with_charge_length(0.503), with_charge_length(0.617)}},
      {"wall_thickness",
       {with_radii(77.5e-3, 66.25e-3), with_radii(77.5e-3, 63.75e-3)},
       {with_radii(77.5e-3, 66.3e-3), with_radii(77.5e-3, 63.7e-3)}},
      {"crack_radius", {cracks(0.0), cracks(60e-6)}, {cracks(61e-6)}},
      {"flaw_size", {flaws(0.5e-3), flaws(1e-3)}, {flaws(0.49e-3), flaws(1.01e-3)}},
      {"steel", {steel(0.95), steel(1.0 / 0.95)}, {steel(0.949), steel(1.054)}},
      {"explosive", {density(0.95), density(1.0 / 0.95)}, {density(0.949), density(1.054)}},
  };
  EXPECT_EQ(outside(fitted_launch().scene), Names{});
  ASSERT_EQ(intervals.size(), range_keys().size());
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const Interval& each = intervals[i];
    EXPECT_EQ(range_keys()[i].name, each.name);
    EXPECT_EQ(range_keys()[i].acceptable, each.name != std::string("explosive"));
    for (const Change& change : each.inside) EXPECT_EQ(outside_after(change), Names{}) << each.name;
    for (const Change& change : each.outside) EXPECT_EQ(outside_after(change), Names{each.name});
  }
}

TEST(ConstantsRange, AnIntervalThatIsNotStatedHoldsForNothing) {
  for (const RangeKey& key : range_keys()) {
    Constants constants = fitted_launch();
    constants.range.erase(key.name);
    EXPECT_EQ(outside(constants.scene, constants), Names{key.name});
  }
}

/// All but what has an interval of its own, and the ignition temperature, which is one of the constants.
TEST(ConstantsRange, EveryNumberOfTheChargeMakesAnotherExplosive) {
  std::size_t tried = 0;
  for (const auto& key : Charge::parameters()) {
    if (key.name == "charge.crack_radius" || key.name == "charge.flaw_size" ||
        key.name == "kinetics.ignition_temperature")
      continue;
    Scene scene = fitted_launch().scene;
    Value value = key.get(scene.charge());
    if (auto* number = std::get_if<double>(&value)) *number *= 1.06;
    if (auto* numbers = std::get_if<std::vector<double>>(&value)) numbers->back() *= 1.06;
    if (auto* flag = std::get_if<bool>(&value)) *flag = !*flag;
    if (value == key.get(scene.charge())) continue;  // 0
    key.set(scene.charge(), value);
    EXPECT_EQ(outside(scene), Names{"explosive"}) << key.name;
    EXPECT_NE(outside_of_range(fitted_launch(), scene).at(0).found.find(key.name), std::string::npos)
        << key.name;
    ++tried;
  }
  EXPECT_GE(tried, 20u);
  Scene scene = fitted_launch().scene;
  scene.charge().kinetics.ignition_temperature *= 1.01;  // a constant itself
  EXPECT_EQ(outside(scene), Names{"explosive"});
}

/// By all bodies, whatever their materials are called.
TEST(ConstantsRange, AnotherMaterialOfOneBodyIsAnotherSteel) {
  Scene scene = fitted_launch().scene;
  scene.materials.push_back({"second", scene.steel()});
  scene.bodies.back().material = "second";
  EXPECT_EQ(outside(scene), Names{});
  std::get<Steel>(scene.materials.back().law).strength.a *= 1.06;
  EXPECT_EQ(outside(scene), Names{"steel"});
  scene.materials.back().law = materials::LinearElastic{};
  EXPECT_EQ(outside(scene), Names{"steel"});
}

/// Of the covariance [4 2 1; 2 3 1; 1 1 2] the last two while the first stays: [3 1; 1 2] - [2; 1] [2 1]/4.
TEST(ConstantsRange, SkinConstantsVaryWhileTheLaunchStays) {
  Constants constants = fitted_launch();
  constants.fitted_keys = {"load.width", "friction.localisation", "gap.exchange_time"};
  constants.covariance = {4, 2, 1, 2, 3, 1, 1, 1, 2};
  const SkinConstants of_skin = skin_constants(constants);
  EXPECT_EQ(of_skin.keys, (Names{"friction.localisation", "gap.exchange_time"}));
  ASSERT_EQ(of_skin.covariance.size(), 4u);
  const std::vector<double> expected{2.0, 0.5, 0.5, 1.75};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(of_skin.covariance[i], expected[i], 1e-12) << i;
  constants.fitted_keys = {"load.width"};
  constants.covariance = {4};
  EXPECT_TRUE(skin_constants(constants).keys.empty());
}

TEST(ConstantsRange, LargestMisfitIsThatOfFittedTemperatures) {
  Constants constants = fitted_launch();
  constants.rows = {{"T at 18 ms", 0.0, 416.1, 414.0, "K", true},
                    {"T at 10 ms", 0.0, 328.5, 329.5, "K", true},
                    {"T at 18 ms", 1e-4, 442.2, 450.0, "K", false},
                    {"spread at 18 ms", 0.0, 36.1, 20.0, "K", true}};
  EXPECT_NEAR(largest_temperature_misfit(constants), 2.1, 1e-9);
}

TEST(ConstantsRange, FaultsNameTheInterval) {
  const std::string text = to_toml(fitted_launch());
  for (const auto& [from, to, key] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"calibre = ", "caliber = ", "range.caliber"},
           {"\"150 to 160 mm\"", "\"150 to 160 MPa\"", "range.calibre"},
           {"\"150 to 160 mm\"", "\"160 to 150 mm\"", "range.calibre"},
           {"\"150 to 160 mm\"", "\"155 mm\"", "range.calibre"},
           {"explosive = \"5 %\"", "explosive = \"5 mm\"", "range.explosive"},
           {"explosive = \"5 %\"", "explosive = 5", "range.explosive"}}) {
    const auto refused = caught([&] { return parse_constants(with(text, from, to), "constants.toml"); });
    ASSERT_FALSE(refused) << to;
    EXPECT_EQ(refused.error().key, key) << refused.error().message();
  }
}

}  // namespace
