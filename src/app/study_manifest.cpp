#include "study_manifest.hpp"

#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace launchsafe::app {
namespace {

std::filesystem::path manifest_path(const std::filesystem::path& folder) { return folder / "manifest.json"; }

/// The study file's values; empty if the file has gone since it was read.
std::string values_of(const std::string& path) {
  const auto text = scene::read_text_file(path);
  if (!text) return {};
  const auto table = scene::parse_toml(*text, path);
  if (!table) return {};
  std::ostringstream values;
  values << *table;
  return values.str();
}

nlohmann::ordered_json json_of(const store::Manifest& manifest) {
  nlohmann::ordered_json libraries;
  for (const store::LibraryVersion& library : manifest.libraries) libraries[library.name] = library.version;
  return {{"input_sha256", manifest.input_sha256},
          {"program_version", manifest.program_version},
          {"commit", manifest.commit},
          {"compiler", manifest.compiler},
          {"compiler_flags", manifest.compiler_flags},
          {"build_type", manifest.build_type},
          {"libraries", libraries},
          {"host", manifest.host},
          {"threads", manifest.threads},
          {"start_time", manifest.start_time},
          {"wall_time_s", manifest.wall_time},
          {"input", manifest.input_text}};
}

}  // namespace

store::Manifest study_manifest(const study::StudyFile& file, int jobs) {
  std::string input = values_of(file.file);
  for (const study::StudyCase& each : file.cases) {
    input += fmt::format("\n\n# {}\n{}", each.label, scene::to_toml(each.scene.scene));
  }
  return store::make_manifest(std::move(input), jobs);
}

std::optional<std::string> study_conflict(const std::filesystem::path& folder,
                                          const store::Manifest& manifest) {
  const auto text = store::read_file(manifest_path(folder));
  if (!text) {
    if (text.error().kind == store::Error::Kind::missing) return std::nullopt;
    return text.error().message;
  }
  const auto present = nlohmann::json::parse(*text, nullptr, false);
  if (present.is_object() && present.value("input_sha256", "") == manifest.input_sha256) return std::nullopt;
  return fmt::format(
      "{} holds the results of a different study, and nothing is overwritten; name another folder",
      folder.string());
}

store::MaybeError write_study_manifest(const std::filesystem::path& folder, const store::Manifest& manifest) {
  return store::write_file_atomically(
      manifest_path(folder),
      {json_of(manifest).dump(2, ' ', false, nlohmann::json::error_handler_t::replace), "\n"});
}

}  // namespace launchsafe::app
