// A scene key that a study varies, as people and programs read it: one unit for all of its values.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/study/study_file.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::report {

/// A value in a unit of its dimension, as if it had been written so: 3e-05 m is 30 um, to the last digit.
double as_written(double value_si, scene::Dimension dimension, std::string_view unit);

/// A gap in cm, likewise.
inline double in_centimetres(double metres) { return as_written(metres, scene::Dimension::length, "cm"); }

/// The unit in which all of these values read best, among those that people use; empty for pure numbers.
std::string unit_for(const std::vector<double>& si_values, scene::Dimension dimension);

struct ShownKey {
  std::string name;       ///< as people read it: "peak pressure", "load.exponent"
  std::string key;        ///< of columns and JSON: "peak_pressure_MPa", "load_exponent"
  std::string unit;       ///< empty for pure numbers
  std::string scene_key;  ///< "load.peak"
  scene::Dimension dimension = scene::Dimension::number;

  double value(double value_si) const { return as_written(value_si, dimension, unit); }
  std::string text(double value_si) const;  ///< "496 MPa"
  std::string heading() const;              ///< "peak pressure [MPa]"
  Column column() const;
};

ShownKey shown(const study::Axis& axis);
std::vector<ShownKey> shown_axes(const study::Study& study);

/// "400, 450, 496 MPa"; long lists by their ends and their number.
std::string values_text(const ShownKey& key, const std::vector<double>& si_values);
/// "uniform from 400 to 600 MPa", "normal, 30 +- 5 um, cut off at 10 and 50 um".
std::string distribution_text(const ShownKey& key, const math::Distribution& distribution);

/// "600 MPa, 30 um": where a case lies; empty without coordinates.
std::string place_text(const std::vector<ShownKey>& keys, const std::vector<double>& coordinates);

}  // namespace launchsafe::report
