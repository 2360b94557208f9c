#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

std::string to_string(scene::FrictionClosure closure) { return std::string(scene::word_of(closure)); }

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
