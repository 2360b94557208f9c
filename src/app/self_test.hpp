// What `launchsafe verify` computes, and what must come out: a self-test of an installed program. The laws
// and the mechanics have their full tests in the source.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::app {

/// One number that the program must reproduce; not yet computed.
struct SelfTest {
  std::string group, name;  ///< "air", "temperature at 496 MPa"
  double expected = 0;
  double tolerance = 0;  ///< > 0, in `unit`: largest distance from the expected number
  std::string unit;      ///< empty for a pure number
  std::string source;    ///< where the expected number comes from
  std::function<double()> compute;
};

/// All of them: a second or so on one core.
std::vector<SelfTest> self_tests();

}  // namespace launchsafe::app
