// A quantity of a result as data: its name in files and for people, dimension, unit, digits, what it means,
// and the member of a row that has it. What declares such a row lists its quantities beside it; tables on a
// terminal and on a page, CSV, JSON, axes of pictures, sentences and the reference of results go through the
// list. Rows hold SI units; only what is shown has the quantity's own.
#pragma once

#include "launchsafe/keys/key.hpp"

#include <cctype>
#include <cmath>
#include <cstdint>

namespace launchsafe::keys {

/// A unit in which results are shown: a power of ten of the SI unit.
struct Unit {
  Dimension dimension = Dimension::number;
  std::string_view name = {};  ///< one that scene::units_of has; empty for pure numbers
};

inline constexpr Unit centimetre{Dimension::length, "cm"}, millimetre{Dimension::length, "mm"},
    micrometre{Dimension::length, "µm"}, second{Dimension::time, "s"}, millisecond{Dimension::time, "ms"},
    megapascal{Dimension::pressure, "MPa"}, kelvin{Dimension::temperature, "K"},
    metre_per_second{Dimension::speed, "m/s"}, per_second{Dimension::frequency, "1/s"},
    percent{Dimension::share, "%"}, gram{Dimension::mass, "g"}, kilogram{Dimension::mass, "kg"},
    cubic_centimetre{Dimension::volume, "cm3"}, joule{Dimension::energy, "J"},
    kilojoule{Dimension::energy, "kJ"}, kilojoule_per_area{Dimension::energy_per_area, "kJ/m2"},
    megabyte{Dimension::memory, "MB"};
/// Of lines over the gap, which are fitted in this unit, as the paper prints them.
inline constexpr Unit kelvin_per_centimetre{Dimension::number, "K/cm"};

/// `text` is no number; fixed and scientific have so many digits after the point, significant so many in all.
enum class Notation { text, fixed, scientific, significant };

/// Towards which side a value is rounded for people: a lower bound down, an upper one and what is uncertain
/// up.
enum class Rounding { nearest, down, up };

/// How a value is shown.
struct Form {
  Notation notation = Notation::text;
  int digits = 0;
  Dimension dimension = Dimension::number;
  std::string unit = {};
  Rounding rounding = Rounding::nearest;
};

inline Form text() { return {}; }
inline Form fixed(int decimals, Unit unit = {}) {
  return {Notation::fixed, decimals, unit.dimension, std::string(unit.name)};
}
inline Form scientific(int decimals, Unit unit = {}) {
  return {Notation::scientific, decimals, unit.dimension, std::string(unit.name)};
}
inline Form significant(int digits, Unit unit = {}) {
  return {Notation::significant, digits, unit.dimension, std::string(unit.name)};
}
inline Form count() { return fixed(0); }
inline Form down(Form form) {
  form.rounding = Rounding::down;
  return form;
}
inline Form up(Form form) {
  form.rounding = Rounding::up;
  return form;
}

/// Who reads a quantity: people text and Markdown, programs CSV and JSON.
enum class Audience { everyone, people, programs };

/// Letters, digits and single underscores: "J/(kg K)" becomes "J_per_kg_K", "%" "percent".
inline std::string key_text(std::string_view text) {
  std::string key;
  for (const char character : text) {
    if (character == '%') {
      key += "percent";
    } else if (std::isalnum(static_cast<unsigned char>(character)) != 0) {
      key += character;
    } else {
      if (!key.empty() && key.back() != '_') key += '_';
      if (character == '/') key += "per_";
    }
  }
  key.resize(key.find_last_not_of('_') + 1);
  return key;
}

/// A unit within a key: of a rate it is a word, and micro is "u".
inline std::string unit_key(std::string_view unit) {
  if (unit == per_second.name) return "per_second";
  constexpr std::string_view micro = "µ";
  return unit.starts_with(micro) ? "u" + key_text(unit.substr(micro.size())) : key_text(unit);
}

/// All there is to say about a quantity, apart from where its value is.
struct QuantityDescription {
  std::string name = {};     ///< in files, without its unit: "critical_gap"
  std::string heading = {};  ///< as people read it: "critical gap"
  Form form = {};
  std::string meaning = {};  ///< a sentence
  Audience audience = Audience::everyone;
  bool always = false;  ///< of a number: told even where it is not finite, as a result should have it

  /// "critical_gap_cm".
  std::string key() const { return form.unit.empty() ? name : name + "_" + unit_key(form.unit); }
  /// "critical gap [cm]".
  std::string label() const { return form.unit.empty() ? heading : heading + " [" + form.unit + "]"; }
};

/// The same quantity for programs, or for people, alone.
template <class Described>
Described for_programs(Described described) {
  described.audience = Audience::programs;
  return described;
}
template <class Described>
Described for_people(Described described) {
  described.audience = Audience::people;
  return described;
}
/// The same quantity, told even where it is not finite.
inline QuantityDescription always(QuantityDescription described) {
  described.always = true;
  return described;
}
/// The same quantity under another heading.
inline QuantityDescription headed(std::string heading, QuantityDescription described) {
  described.heading = std::move(heading);
  return described;
}
/// The same quantity under another name.
inline QuantityDescription named(std::string name, QuantityDescription described) {
  described.name = std::move(name);
  return described;
}

/// Nothing, a text, a number, or a count.
using Cell = std::variant<std::monostate, std::string, double, std::int64_t>;

/// A member of a row as a cell, in SI: an enumerator by its `to_string`, true as "yes".
template <class Value>
Cell cell_of(const Value& value) {
  if constexpr (std::is_same_v<Value, Cell>) {
    return value;
  } else if constexpr (std::is_same_v<Value, bool>) {
    return std::string(value ? "yes" : "no");
  } else if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else if constexpr (std::is_integral_v<Value>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_enum_v<Value>) {
    return std::string(to_string(value));
  } else if constexpr (requires { value.has_value(); }) {
    return value ? cell_of(*value) : Cell();
  } else {
    return std::string(value);
  }
}

/// What a member of an object, or of a member of it, holds. Nothing beyond a pointer that is null, or an
/// optional that is empty.
template <class Object, class Member, class... Further>
Cell cell_at(const Object& object, Member member, Further... further) {
  const auto& part = std::invoke(member, object);
  if constexpr (sizeof...(further) == 0)
    return cell_of(part);
  else if constexpr (requires { *part; })
    return part ? cell_at(*part, further...) : Cell();
  else
    return cell_at(part, further...);
}

/// A described quantity bound to a row.
template <class Row>
struct Quantity : QuantityDescription {
  /// `path`: a pointer to a member, or a function, of a row, then of what that is or points to, and so on.
  template <class... Path>
  Quantity(QuantityDescription described, Path... path)
      : QuantityDescription(std::move(described)),
        get([=](const Row& row) { return cell_at(row, path...); }) {}
  /// One that nothing else describes.
  template <class... Path>
  Quantity(std::string its_name, std::string its_heading, Form its_form, std::string its_meaning,
           Path... path)
      : Quantity({std::move(its_name), std::move(its_heading), std::move(its_form), std::move(its_meaning)},
                 path...) {}

  /// Its value in SI; nothing for a number that is not there.
  Cell value(const Row& row) const {
    Cell cell = get(row);
    const double* number = std::get_if<double>(&cell);
    return number != nullptr && !always && !std::isfinite(*number) ? Cell() : cell;
  }

  std::function<Cell(const Row&)> get;
};

template <class Row>
using Quantities = std::vector<Quantity<Row>>;

/// A number that may not be there, of a quantity that is always told.
inline std::optional<double> known(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The quantities of a part as those of the row that has it. `path`: to the part, as of a Quantity.
template <class Row, class Part, class... Path>
Quantities<Row> of_part(const Quantities<Part>& quantities, Path... path) {
  Quantities<Row> lifted;
  for (const Quantity<Part>& each : quantities)
    lifted.emplace_back(each, path..., [each](const Part& part) { return each.value(part); });
  return lifted;
}

/// What there is to say about the quantities of a list.
template <class Row>
std::vector<QuantityDescription> described(const Quantities<Row>& quantities) {
  return {quantities.begin(), quantities.end()};
}

}  // namespace launchsafe::keys
