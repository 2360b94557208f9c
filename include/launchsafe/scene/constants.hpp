// Constants files: the numbers of a launch that were fitted to published temperatures, or chosen with them,
// and what the fit missed. A scene takes every one that it does not state itself.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {

/// Version of the physics: raised by hand whenever the same scene gives other numbers than before. It is part
/// of what determines a stored launch, and constants of another version are refused. The test ModelVersion.*
/// fails when numbers change and this did not.
inline constexpr int model_version = 8;

/// A published number beside the one that the launch with the constants gives.
struct FittedNumber {
  std::string quantity;  ///< "T at 10 ms", "spread at 18 ms", ...
  double gap = 0;        ///< m
  double published = 0, computed = 0;
  std::string unit;        ///< of both: "K" or "ms"
  bool is_fitted = false;  ///< the fit used it; the others are a check
  double misfit() const { return computed - published; }
};

/// A constants file.
struct Constants {
  std::string name;       ///< as a scene or study names it: "155mm", "own/constants.toml"
  std::string title;      ///< of the calibration
  std::string command;    ///< that writes the file anew
  int model_version = 0;  ///< of the program that fitted them

  /// Values by the key of a scene. What holds the charge stands under the face that is held:
  /// "interface.front.condition", "interface.side.friction", "interface.bottom.condition".
  std::map<std::string, Value> values;

  std::vector<std::string> fitted_keys;  ///< of `values`, found by least squares
  std::vector<double> covariance;        ///< of the logarithms of these, row by row
  /// Temperatures [K] between which the ignition temperature lies; it is the middle.
  double ignition_lowest = 0, ignition_highest = 0;
  std::vector<FittedNumber> rows;

  /// Intervals of inputs in which the constants hold, by the names of range_keys, as people write them.
  std::map<std::string, std::string> range;
  Scene scene;  ///< the launch that they were fitted on, with the constants
};

/// Constants that ship with the program, by name; texts in studies/constants. The first is the default.
const std::vector<std::shared_ptr<const Constants>>& shipped_constants();
/// Name of the constants of scenes that name none, and of those that take none at all.
inline constexpr const char *default_constants = "155mm", *no_constants = "none";

/// Reads a constants file from text; `file` is named in errors. Throws an InputError for another model
/// version, an unknown key, and a value that its key cannot have.
Constants parse_constants(const std::string& text, const std::string& file);
std::string to_toml(const Constants& constants);

/// An interval of the inputs of a launch in which constants hold.
struct RangeKey {
  std::string name;  ///< "calibre"
  /// Measure of its ends: a pressure, a length, ...; a share is the largest relative difference of any number
  /// of a material from that of the launch that was fitted.
  Dimension dimension = Dimension::length;
  bool acceptable = true;  ///< whether a study may go beyond it with a reason
  std::string meaning;
};
const std::vector<RangeKey>& range_keys();

/// An interval that a scene lies outside of.
struct OutsideOfRange {
  std::string name;
  std::string found, allowed;  ///< for people
  bool acceptable = true;
};
/// Those of constants that a scene lies outside of, in the order of range_keys; an interval that the
/// constants do not state holds for nothing.
std::vector<OutsideOfRange> outside_of_range(const Constants& constants, const Scene& scene);

/// The fitted constants that act on the skin alone, and the covariance of their logarithms, row by row, while
/// the others, which make the launch, stay as they are.
struct SkinConstants {
  std::vector<std::string> keys;
  std::vector<double> covariance;
};
SkinConstants skin_constants(const Constants& constants);

/// K, the largest temperature that the fit missed.
double largest_temperature_misfit(const Constants& constants);

/// The constants of a name: shipped ones, the file at a path from `folder`, or none (null). Throws an
/// InputError at `place` of `key` for a name that is neither.
std::shared_ptr<const Constants> find_constants(const std::string& name, const std::filesystem::path& folder,
                                                const Place& place, const std::string& key);

/// The scene of a file with other constants; null: with none.
SceneFile with_constants(const SceneFile& file, std::shared_ptr<const Constants> constants);

/// A key of constants as the key of a scene: "interface.side.friction" is "interface.wall.friction" where a
/// body `wall` bears on the charge's side. Empty where the scene has no such body.
std::string key_in_scene(const Scene& scene, const std::string& key);

}  // namespace launchsafe::scene
