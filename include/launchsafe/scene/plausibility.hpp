// Values that are allowed but that no launch has: a verdict that rests on one is indeterminate, unless the
// scene or its study says why it is meant: accept = [{ key = "...", value = "...", because = "..." }].
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::scene {

/// Accepted by these names: bodies, constants of their materials, and what holds the charge, where they are
/// not those of the calibration. Which they are only a study knows (study/record_domain.hpp).
inline constexpr const char *foreign_shell = "calibration.shell", *foreign_material = "calibration.material",
                            *foreign_interfaces = "calibration.interfaces";
/// Likewise a peak pressure beyond those at which other models of the launch were compared.
inline constexpr const char* pressure_of_models = "model_form.pressure";

/// A value on which no verdict but UNSAFE rests unless the user accepts it: it is not plausible, or not the
/// calibrated one.
struct Implausible {
  std::string key;             ///< of the scene or study, or a quantity that follows from keys
  std::string value;           ///< as people read it
  std::string range;           ///< what is plausible, with its reason, or what is calibrated
  std::string because;         ///< why the user accepts it; empty: he does not
  std::string accepted_value;  ///< what he says of the key's value, be it this one or not; empty: nothing
  bool accepted() const { return !because.empty(); }
};

/// Whether two values are one: numbers up to a relative tolerance.
bool same_value(const Value& a, const Value& b, double tolerance);

/// The value of a key, under its full name, with what the user says of it. A number is accepted by itself, in
/// the digits that people read, or by a range around it.
Implausible implausible(const std::vector<Acceptance>& accepted, const KeyDescription& key, std::string name,
                        const Value& value, std::string range);

/// "gap.exchange_time = 100 s", and what the user accepts in its place.
std::string value_text(const Implausible& value);
/// "accepted: gap.exchange_time = 100 s, because ...; ..." of those that are; empty if none is.
std::string accepted_text(const std::vector<Implausible>& values);
/// The lines of a file, ready to copy but for the reasons, that accept those that are not accepted; empty if
/// all are.
std::string acceptances_to_write(const std::vector<Implausible>& values);

const std::vector<Key<Acceptance>>& acceptance_keys();

/// Throws the fault of `key` at a place where a text is no reason in words, such as "x" or several lines.
void check_reason(const std::string& text, const Place& place, const std::string& key);

/// The table "accept" of a file; none if it has none. Faults: a key that is not among `known`, one that
/// stands there twice with one value, a value that the key cannot have, a range beyond a factor of 2, a
/// reason without letters or of several lines.
Expected<std::vector<Acceptance>> read_acceptances(const toml::table& root,
                                                   const std::vector<KeyDescription>& known,
                                                   const std::string& file);

/// Adds an acceptance; it replaces an earlier one of the same key and value.
void accept(std::vector<Acceptance>& accepted, Acceptance acceptance);

// --- What is not plausible. ---

/// "gap.exchange_time = 100 s is not plausible (0.05 ms to 2 ms, because ...)".
std::string validity_warning(const Implausible& value);

/// Whether a value is what is expected of its key. NaN never is.
bool is_plausible(const KeyDescription& key, const Value& value);

/// A quantity that follows from several keys and that they may make meaningless while each of them is
/// plausible.
struct DerivedQuantity {
  KeyDescription description;
  /// SI, of a scene and of its motion as one rigid body until scene::read_time; none where a scene has no
  /// such quantity.
  std::function<std::optional<double>(const Scene& scene, const RigidMotion& launch)> value;
};
const std::vector<DerivedQuantity>& derived_quantities();

/// All values of a scene that are not plausible, accepted or not: keys in the order of their declaration,
/// bodies, then derived quantities. They depend on the scene alone, whatever file or study it came from.
std::vector<Implausible> implausible_values(const Scene& scene);
/// The same where the motion until scene::read_time is known.
std::vector<Implausible> implausible_values(const Scene& scene, const RigidMotion& launch);

/// What `accept` may name: scene keys, "body.<name>.x" and ".r", derived quantities, and what of a
/// calibration is foreign.
std::vector<KeyDescription> acceptable_keys(const Scene& scene);

}  // namespace launchsafe::scene
