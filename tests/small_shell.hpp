// The bodies of a small shell, for scenes as text.
#pragma once

#include <string>

namespace launchsafe::testing {

/// A cup with its filling and wall; no base.
inline const std::string small_shell = R"(
[[body]]
name = "cup"
material = "steel"
x = "0 to 1 cm"
r = "0 to 2 cm"

[[body]]
name = "filling"
material = "charge"
x = "1 to 4 cm"
r = "0 to 1.5 cm"

[[body]]
name = "wall"
material = "steel"
x = "1 to 4 cm"
r = "1.5 to 2 cm"
)";

inline const std::string small_shell_base = R"(
[[body]]
name = "base"
material = "steel"
x = "4 to 5 cm"
r = "0 to 2 cm"
)";

/// An observation point at the bottom of the filling.
inline const std::string small_shell_point = R"(
[[observation_point]]
name = "G1"
x = "3.9 cm"
r = "1 cm"
)";

}  // namespace launchsafe::testing
