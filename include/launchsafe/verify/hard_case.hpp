// A computation where it is stiff or extreme, what must hold there, and what did.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// What became of a hard case.
enum class Outcome {
  held,      ///< what must hold held
  degraded,  ///< it did not, or not fully, and the result says so itself
  caught,    ///< the computation was stopped or flagged
  wrong      ///< a broken computation gave a finite, plausible result without a word
};
std::string to_string(Outcome outcome);  ///< "held", "degraded", "caught", "WRONG"

struct Finding {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the numbers behind it, or the reason
};

/// One hard case, not yet computed.
struct HardCase {
  std::string group;                 ///< "stiff: thermal explosion"
  std::string name;                  ///< "comp-b, 2000 K, step 1 ms"
  std::string must_hold;             ///< a sentence
  std::function<Finding()> compute;  ///< deterministic; may be called from any thread
};

/// The laws by themselves at stiff and extreme arguments: thermal explosion, Maxwell elements, exchange with
/// the air, crack growth, conduction, Johnson-Cook, equations of state, air.
std::vector<HardCase> hard_laws();

}  // namespace launchsafe::verify
