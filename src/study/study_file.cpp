#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

std::string to_string(scene::FrictionClosure closure) {
  switch (closure) {
    case scene::FrictionClosure::literal:
      return "literal";
    case scene::FrictionClosure::inelastic:
      return "inelastic";
    case scene::FrictionClosure::none:
      return "none";
  }
  return "none";
}

std::string to_string(Use use) {
  switch (use) {
    case Use::held_out:
      return "held out";
    case Use::selection:
      return "selection";
    case Use::calibration:
      return "calibration";
  }
  return "held out";
}

}  // namespace launchsafe::study
