// What another value of an input changes, and what a record says of it: said once, on the line of its key.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::keys {

/// The value of any key: number; flag; word, words ("a, b") or text; list or range.
using Value = std::variant<double, bool, std::string, std::vector<double>>;

/// What another value of an input changes, and what follows from that. Where a launch has no bulk reaction,
/// conduction, or stored temperatures (scene::mechanical_part), the mechanics does not know them.
enum class ActsOn {
  mechanics,   ///< the mechanical run
  numerics,    ///< likewise, by its error alone
  trace,       ///< the skin, and what the mechanical run traces for it
  heat,        ///< the skin, and the mechanical run where temperatures of the charge matter to it
  conduction,  ///< likewise, where heat is conducted
  chemistry,   ///< likewise, where the bulk reacts
  surface,     ///< the skin
  combustion,  ///< what follows ignition
  nothing      ///< no number that is computed
};
/// Whether a mechanical run may depend on it, in this launch or in another one.
constexpr bool reaches_mechanics(ActsOn acts_on) { return acts_on < ActsOn::surface; }

/// The part of an input in a record: what the record says where the input has another value.
enum class Part {
  constant,       ///< nothing
  model,          ///< likewise; models of one launch may differ in it
  calibrated,     ///< nothing, of a constant that every model of a launch is calibrated in
  range,          ///< its errors carried over: relative ones, or as far as a record of accuracy covers
  load_shape,     ///< likewise
  setting,        ///< what it has of this setting: finer or coarser, with another error
  minor_setting,  ///< likewise; the calibrated constants do not feel it
  free            ///< all: it is judged elsewhere, or computes nothing
};

/// Which values of a calibrated constant make a hotter skin or an earlier ignition; over these its relative
/// error is carried.
enum class Hotter { nowhere, above, below };

/// Of a setting: whether the limit of ever finer cells is free of the error that it makes, or where it makes
/// none, or less; nothing of it where that is not known.
struct Exactness {
  bool vanishes = false;  ///< with the cells, or it is measured in every case
  std::optional<Value> value = {};
};

/// What an input does to results and records. One that says nothing changes everything: forgetting it makes
/// records void, and never a launch safe.
struct Role {
  ActsOn acts_on = ActsOn::mechanics;
  Part part = Part::constant;
  Hotter hotter = Hotter::nowhere;
  Exactness exactness = {};
};
// Those that many inputs have.
inline const Role remark{ActsOn::nothing, Part::free}, judged_elsewhere{ActsOn::mechanics, Part::free},
    of_combustion{ActsOn::combustion, Part::free}, over_range{ActsOn::mechanics, Part::range},
    of_model{ActsOn::mechanics, Part::model},
    vanishing_setting{ActsOn::numerics, Part::setting, {}, {.vanishes = true}},
    minor_setting{ActsOn::numerics, Part::minor_setting, {}, {.vanishes = true}};
inline Role setting_exact_at(Value value) {
  return {ActsOn::numerics, Part::setting, {}, {.value = std::move(value)}};
}

}  // namespace launchsafe::keys
