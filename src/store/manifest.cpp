#include "launchsafe/store/case_file.hpp"
#include "launchsafe/version.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <ctime>

namespace launchsafe::store {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string program_of(const Manifest& manifest) {
  return fmt::format("launchsafe {}, commit {}", manifest.program_version, manifest.commit);
}

Manifest make_manifest(std::string input_text, int threads) {
  Manifest manifest;
  manifest.input_sha256 = sha256(input_text);
  manifest.input_text = std::move(input_text);
  manifest.model_version = run::model_version;
  manifest.program_version = version::number;
  manifest.commit = version::commit;
  manifest.compiler = version::compiler;
  manifest.compiler_flags = version::flags;
  manifest.build_type = version::build_type;
  manifest.host = host_name();
  manifest.threads = threads;
  manifest.start_time = utc_now();
  return manifest;
}

}  // namespace launchsafe::store
