// Numbers with units, as users write them ("2.5 mm", "0 to 11.8 cm", "0, 0.01, 0.02 cm"), to SI and back.
#pragma once

#include "launchsafe/keys/key.hpp"
#include "launchsafe/scene/input_error.hpp"

#include <fmt/format.h>

namespace launchsafe::scene {

using keys::Dimension;

/// What the difference of two quantities measures: of two temperatures, a temperature difference; else the
/// same.
Dimension difference_of(Dimension dimension);
/// "length", "temperature", ... for messages.
std::string_view name_of(Dimension dimension);
/// "m", "K", ...; empty for numbers, counts and shares.
std::string_view si_unit_of(Dimension dimension);
/// A value as it is written in a scene, with its quotation marks: `"2.5 cm"`, `0.5`.
std::string example_of(Dimension dimension);
/// Names of all units of a dimension, the one users commonly write first.
std::vector<std::string> units_of(Dimension dimension);

// These throw an InputError without a place, which the reader that knows it adds.

/// One number and its unit: "2.5 mm". The result is the double nearest to the decimal number in SI: "11.8 cm"
/// is exactly 0.118. A comma for a decimal point is a fault.
double parse_quantity(std::string_view text, Dimension dimension);
/// "0 to 11.8 cm" or "0 cm to 118 mm": two numbers, lower first; a number without a unit takes the next
/// one's.
std::vector<double> parse_range(std::string_view text, Dimension dimension);
/// "0, 0.01, 0.02 cm": one or more numbers; a number without a unit takes the next one's. A comma between
/// two digits ("0,5", "1,000") is a fault, as it may be meant for decimals or thousands.
std::vector<double> parse_list(std::string_view text, Dimension dimension);

/// For people: six digits in the unit that reads best, such as "0.25 cm", "18 ms", "496 MPa".
std::string format_quantity(double value_si, Dimension dimension);
/// The same of a length (m), a time (s) and a pressure (Pa).
std::string length_text(double length);
std::string time_text(double time);
std::string pressure_text(double pressure);

/// A value in a named unit of the dimension ("cm"), as a number; NaN for a unit that the dimension does not
/// have.
double in_unit(double value_si, Dimension dimension, std::string_view unit);
/// A value in a unit that is a power of ten of the SI unit, as if it had been written so: 3e-05 m is 30 µm,
/// to the last digit. It itself in any other unit.
double as_written(double value_si, Dimension dimension, std::string_view unit);

}  // namespace launchsafe::scene
