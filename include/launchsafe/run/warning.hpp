// Validity warnings have names: a study accepts some of them by name, and nothing accepts the others.
#pragma once

#include <string>
#include <vector>

namespace launchsafe::run {

/// A kind of validity warning.
struct WarningKind {
  std::string name;
  bool acceptable = false;  ///< whether a study may accept it by name, with a reason
  std::string meaning;      ///< one sentence
};

/// All kinds, those that nothing accepts first. Names are unique.
const std::vector<WarningKind>& warning_kinds();

/// Whether a study may accept warnings of this name; false for a name of no kind.
bool is_acceptable(const std::string& name);

/// A reason why a launch that completed is no basis for a SAFE verdict.
struct Warning {
  std::string name;  ///< of its kind
  std::string text;  ///< a clause with the numbers of this launch
  bool operator==(const Warning&) const = default;
};

}  // namespace launchsafe::run
