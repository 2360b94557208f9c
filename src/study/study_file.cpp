#include "launchsafe/study/study_file.hpp"

#include <array>

namespace launchsafe::study {

std::string to_string(scene::FrictionClosure closure) { return std::string(scene::word_of(closure)); }

std::string to_string(Use use) {
  constexpr std::array words{"held out", "chosen by", "fitted"};
  return words.at(static_cast<std::size_t>(use));
}

}  // namespace launchsafe::study
