#include "version_text.hpp"

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/version.hpp"

#include <fmt/format.h>

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

}  // namespace launchsafe::app
