// A scene key that a study varies, as people and programs read it: one unit for all of its values.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/study/study_file.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// The unit in which all of these values read best, among those that people use; empty for pure numbers.
std::string unit_for(const std::vector<double>& si_values, scene::Dimension dimension);

/// The heading is "peak pressure" or "load.exponent", the name peak_pressure or load_exponent.
struct ShownKey : Column {
  std::string scene_key;  ///< "load.peak"

  double value(double value_si) const { return shown_value(value_si, form); }
  std::string text(double value_si) const { return in_words(value_si, form); }  ///< "496 MPa"
};

ShownKey shown(const study::Axis& axis);
std::vector<ShownKey> shown_axes(const study::Study& study);
/// What the axes of a study are in a case, of its coordinates.
Quantities<std::vector<double>> axis_quantities(const study::Study& study);

/// "400, 450, 496 MPa"; long lists by their ends and their number.
std::string values_text(const ShownKey& key, const std::vector<double>& si_values);
/// "uniform from 400 to 600 MPa", "normal, 30 ± 5 µm, cut off at 10 and 50 µm".
std::string distribution_text(const ShownKey& key, const math::Distribution& distribution);

/// Of a key's name, in a picture: "face friction" of "charge.face_friction".
std::string plain_words(std::string name);

/// "600 MPa, 30 µm": where a case lies; empty without coordinates.
std::string place_text(const std::vector<ShownKey>& keys, const std::vector<double>& coordinates);

}  // namespace launchsafe::report
