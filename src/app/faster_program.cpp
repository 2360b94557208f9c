#include "faster_program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace launchsafe::app {

#if LAUNCHSAFE_CHOOSES_PROGRAM && defined(__x86_64__)

namespace {

struct Architecture {
  const char* name;
  bool runs_here;
};

/// bin/launchsafe has its faster forms in lib/launchsafe/ARCHITECTURE/launchsafe.
std::filesystem::path program_for(std::string_view architecture) {
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return self.parent_path().parent_path() / "lib" / "launchsafe" / architecture / "launchsafe";
}

}  // namespace

void become_faster_program(char** arguments) {
  const char* given = std::getenv("LAUNCHSAFE_ARCHITECTURE");
  const std::string_view most = given ? given : "";
  bool allowed = most.empty();
  for (const auto& [name, runs_here] :
       {Architecture{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
        Architecture{"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0}}) {
    allowed = allowed || most == name;
    // What is missing, or no program, is passed over: this one does the same, more slowly.
    if (allowed && runs_here) ::execv(program_for(name).c_str(), arguments);
  }
}

#else

void become_faster_program(char**) {}

#endif

}  // namespace launchsafe::app
