// One scene written in many ways: order, tables, units, numbers, comments.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace launchsafe::scene {

inline const std::string plainly_written_scene = R"(
frame = "co-moving"
load = { duration = "0.05 ms", peak = "496 MPa", peak_time = "0.05 ms", shape = "power-exponential", exponent = 10.5 }
charge = { crack_radius = "0.1 mm", flaw_size = "1.3 mm", relaxation_rates = "0, 7320, 73200, 732000, 2000000 1/s" }
steel = { yield_stress = "792 MPa", taylor_quinney = 0.9 }
gap.thickness = "0, 0.1, 0.39 mm"
numerics = { cell_size = "5 mm", particles_per_cell = 1 }
output.trace_interval = "5 us"
body = [
  { name = "cup",     material = "steel",  x = "0 to 1 cm", r = "0 to 2 cm" },
  { name = "filling", material = "charge", x = "1 to 4 cm", r = "0 to 1.5 cm" },
  { name = "wall",    material = "steel",  x = "1 to 4 cm", r = "1.5 to 2 cm" },
  { name = "base",    material = "steel",  x = "4 to 5 cm", r = "0 to 2 cm" },
]
observation_point = [ { name = "G1", x = "3.9 cm", r = "1 cm" } ]
)";

/// The same in other tables and another order, with comments; beside it a title and an exchange time, which
/// are no matter of the mechanics.
inline const std::string otherwise_written_scene = R"(# a comment = 3
title = "number 7"
steel.taylor_quinney=+0.90
steel.yield_stress   = "0.792 GPa"   # another comment

[output]
trace_interval = "+0.005e0 ms"
[[observation_point]]
r = "10 mm"
name = 'G1'
x = "0.039 m"
[[body]]
material = 'steel'
name = 'cup'
r = "0 cm to 20.00 mm"
x = "0 mm to 1e-2 m"
[[body]]
x = "10 mm to 4 cm"
name = "filling"
material = "charge"
r = "0 to 15000 um"
[charge]
relaxation_rates = "0, 7320, 73200, 732000, 2000000 1/s"
flaw_size = "0.0013 m"
crack_radius = "100 um"
[gap]
exchange_time = "0.3 ms"
thickness = ["0 m", "0.01 cm", "390 um"]
[[body]]
name = "wall"
material = "steel"
r = "1.5 cm to 2 cm"
x = "0.01 to 0.04 m"
[numerics]
particles_per_cell = +1
cell_size = "0.5cm"
[load]
shape = "power-exponential"
exponent = 1.05e1
peak = "4960 bar"
duration = "5e-5 s"
peak_time = "50 us"
[[body]]
name = "base"
material = "steel"
r = "0 to 0.02 m"
x = "40 mm to 50.0 mm"
)";

/// Changes of the plain text, each of which leaves the scene as it is.
inline const std::vector<std::pair<std::string, std::string>> same_again{
    {"frame = \"co-moving\"\n", "\n  # the frame is the default\n"},
    {"\"496 MPa\"", "\" 496.00e0  MPa \""},
    {"\"496 MPa\"", "\"496000000 Pa\""},
    {"exponent = 10.5", "exponent = +10.500"},
    {"\"0.1 mm\"", "\"0.0001 m\""},
    {"\"0, 0.1, 0.39 mm\"", "[\"0 cm\", \"1e-1 mm\", \"0.039 cm\"]"},
    {"\"0, 0.1, 0.39 mm\"", "\"0.0, 1e-4, 0.00039 m\""},
    {"gap.thickness", "gap.exchange_time = \"0.2 ms\"\ngap.thickness"},
    {"x = \"4 to 5 cm\"", "x = \"40000 um to 0.05 m\""},
};

}  // namespace launchsafe::scene
