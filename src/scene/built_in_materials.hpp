// The texts of the shipped materials.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace launchsafe::scene {

struct BuiltInText {
  std::string file, text;
};
/// One for every file in studies/materials.
const std::vector<BuiltInText>& built_in_materials();

/// What `read(table, file, those of the files before)` finds in all of them. A fault is one of the program
/// itself, which tests find.
template <class Named, class Read>
std::vector<Named> read_built_in(Read&& read) {
  std::vector<Named> all;
  for (const BuiltInText& each : built_in_materials()) {
    const auto table = parse_toml(each.text, each.file);
    auto named = table ? read(*table, each.file, all) : Expected<std::vector<Named>>(table.error());
    if (!named) {
      fmt::print(stderr, "{}\n", named.error().message());
      std::abort();
    }
    all.insert(all.end(), named->begin(), named->end());
  }
  return all;
}

}  // namespace launchsafe::scene
