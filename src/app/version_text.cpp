#include "version_text.hpp"

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace launchsafe::app {

std::string version_text() {
  std::string libraries;
  for (const store::LibraryVersion& library : store::library_versions()) {
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", library.name, library.version);
  }
  return fmt::format("launchsafe {}\ncommit    {}\ncompiler  {}\nflags     {} ({})\nlibraries {}",
                     version::number, version::commit, version::compiler, version::flags, version::build_type,
                     libraries);
}

nlohmann::ordered_json version_json() {
  nlohmann::ordered_json libraries = nlohmann::ordered_json::object();
  for (const store::LibraryVersion& library : store::library_versions())
    libraries[library.name] = library.version;
  return {{"version", version::number}, {"commit", version::commit},         {"compiler", version::compiler},
          {"flags", version::flags},    {"build_type", version::build_type}, {"libraries", libraries}};
}

}  // namespace launchsafe::app
