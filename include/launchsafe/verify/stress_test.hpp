// Stress tests: stiff or extreme computations, what must hold, and the outcome.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// What became of a stress test.
enum class Outcome {
  held,      ///< what must hold held
  degraded,  ///< it did not, or not fully, and the result says so itself
  caught,    ///< the computation was stopped or flagged
  wrong      ///< a broken computation gave a finite, plausible result without a flag
};
std::string to_string(Outcome outcome);  ///< "held", "degraded", "caught", "WRONG"

struct Finding {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the numbers behind it, or the reason
};

/// One stress test, not yet computed.
struct StressTest {
  std::string group;                 ///< "stiff: thermal explosion"
  std::string name;                  ///< "comp-b, 2000 K, step 1 ms"
  std::string must_hold;             ///< a sentence
  std::function<Finding()> compute;  ///< deterministic; may be called from any thread
};

/// The laws by themselves at stiff and extreme arguments: thermal explosion, Maxwell elements, exchange with
/// the air, crack growth, conduction, Johnson-Cook, equations of state, air.
std::vector<StressTest> law_stress_tests();

}  // namespace launchsafe::verify
