// The texts of the shipped materials.
#pragma once

#include <string>
#include <vector>

namespace launchsafe::scene {

struct BuiltInText {
  std::string file, text;  ///< "comp-b.toml"
};
/// One for every file in studies/materials.
const std::vector<BuiltInText>& built_in_materials();

}  // namespace launchsafe::scene
