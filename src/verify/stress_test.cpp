#include "launchsafe/verify/stress_test.hpp"

namespace launchsafe::verify {

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::held:
      return "held";
    case Outcome::degraded:
      return "degraded";
    case Outcome::caught:
      return "caught";
    case Outcome::wrong:
      break;
  }
  return "WRONG";
}

}  // namespace launchsafe::verify
