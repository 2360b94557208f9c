#include "launchsafe/store/case_file.hpp"

#include <Eigen/src/Core/util/Macros.h>
#include <boost/version.hpp>
#include <fmt/chrono.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>
#include <openssl/opensslv.h>
#include <sqlite3.h>
#include <toml++/impl/version.h>
#include <unistd.h>

#include <ctime>

// Libraries of the modules above, known here by their headers alone.
#if __has_include(<oneapi/tbb/version.h>)
#include <oneapi/tbb/version.h>
#endif
#if __has_include(<CLI/Version.hpp>)
#include <CLI/Version.hpp>
#endif

#include "launchsafe/version.hpp"

namespace launchsafe::store {

std::vector<LibraryVersion> library_versions() {
  const auto dotted = [](int major, int minor, int patch) {
    return fmt::format("{}.{}.{}", major, minor, patch);
  };
  return {
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Boost", dotted(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"HDF5", dotted(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
      {"SQLite", sqlite3_libversion()},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"nlohmann-json",
       dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"OpenSSL", dotted(OPENSSL_VERSION_MAJOR, OPENSSL_VERSION_MINOR, OPENSSL_VERSION_PATCH)},
#ifdef TBB_VERSION_STRING
      {"oneTBB", TBB_VERSION_STRING},
#endif
#ifdef CLI11_VERSION
      {"CLI11", CLI11_VERSION},
#endif
  };
}

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
  manifest.libraries = library_versions();
  manifest.host = host_name();
  manifest.threads = threads;
  manifest.start_time = utc_now();
  return manifest;
}

}  // namespace launchsafe::store
