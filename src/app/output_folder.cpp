#include "output_folder.hpp"

#include "launchsafe/store/atomic_file.hpp"

#include <unistd.h>

#include <sstream>

namespace launchsafe::app {
namespace {

/// Why a file with this content may not be written there: a link, or something with another content. A file
/// that holds the content already is none.
std::optional<std::string> obstacle_to_file(const path& file, std::string_view content) {
  std::error_code unknown;  // a name that is too long, say: reading it tells
  if (std::filesystem::is_symlink(file, unknown))
    return fmt::format("{} is a link, and nothing is written through one; move it away", file.string());
  const auto present = store::read_file(file);
  if (present && *present == content) return std::nullopt;
  if (!present && present.error().kind == store::Error::Kind::missing) return std::nullopt;
  if (!present) return present.error().message;
  return fmt::format(
      "{} is there with another content, and nothing is overwritten; move it away or name another place",
      file.string());
}

}  // namespace

std::optional<std::string> prepare_output_folder(const path& folder) {
  std::error_code error, unknown;  // a name that is too long, say
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, unknown))
    return fmt::format("{} is no folder and cannot be made one{}; allowed: a folder", folder.string(),
                       error ? " (" + error.message() + ")" : "");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return fmt::format("{} may not be written to; allowed: a folder of yours", folder.string());
  return std::nullopt;
}

std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts, Console& console) {
  console.refuse_any(prepare_output_folder(folder));
  for (const auto& [name, text] : texts) console.refuse_any(obstacle_to_file(folder / name, text));
  std::vector<std::string> said;
  for (const auto& [name, text] : texts) {
    const bool is_there = std::filesystem::exists(folder / name);  // with this content
    said.push_back((is_there ? "kept " : "wrote ") + (folder / name).string());
    if (is_there) continue;
    if (const auto error = store::write_file_atomically(folder / name, text, store::IfExists::refuse))
      console.end_with(*error);
  }
  return said;
}

std::vector<std::string> places_of(const path& folder, const NamedTexts& texts) {
  std::vector<std::string> places;
  for (const report::TextFile& each : texts) places.push_back((folder / each.name).string());
  return places;
}

store::Manifest study_manifest(const study::StudyFile& file, int jobs) {
  std::ostringstream values;  // of the study file; none if it has gone since it was read
  if (const auto text = scene::read_text_file(file.file))
    if (const auto table = scene::parse_toml(*text, file.file)) values << *table;
  std::string input = fmt::format("# model version {}\n{}\n\n# scene\n{}", run::model_version, values.str(),
                                  scene::to_toml(file.scene.scene));
  // With another one its report is no longer true.
  if (!file.records.empty())
    input += fmt::format("\n\n# SHA-256 of the files that it rests on\n{}\n", fmt::join(file.records, "\n"));
  if (file.study.kind.own_scenes) {
    std::string scenes;
    for (const study::StudyCase& each : file.cases) scenes += scene::to_toml(each.scene.scene);
    input += "\n\n# SHA-256 of the scenes of all cases\n" + store::sha256(scenes) + "\n";
  }
  return store::make_manifest(input, jobs);
}

bool same_study(const store::Manifest& one, const store::Manifest& other) {
  return one.input_sha256 == other.input_sha256;
}

bool holds_store(const path& folder) {
  return !store::results_files_in(folder).empty() || !store::list_folder(folder / "cases").empty();
}

std::optional<std::string> obstacle_in_folder(const path& folder, const kinds::Kind& kind,
                                              const store::Manifest& manifest, bool update) {
  const auto record = store::record_of_report(folder);
  if (!record) return record.error().message;
  std::vector<std::string> foreign = store::list_folder(folder);
  std::erase_if(foreign, [&](const std::string& name) {
    return !kinds::may_write(kind, name) ||
           store::state_of(folder, *record, name) != store::FileState::foreign;
  });
  if (!foreign.empty())
    return fmt::format(
        "{} holds files that launchsafe did not write ({}{}), and nothing is overwritten; move them away or "
        "name another folder",
        folder.string(), foreign.front(),
        foreign.size() > 1 ? fmt::format(" and {} more", foreign.size() - 1) : "");
  if (update || record->manifest.input_sha256.empty() || same_study(record->manifest, manifest))
    return std::nullopt;
  return fmt::format(
      "{} holds the results of a different study or model, and nothing is overwritten; with --update the "
      "report there moves to {} and stored cases are used where they fit; or name another folder",
      folder.string(), (folder / "earlier-N").string());
}

void remove_leftovers(const path& folder) {
  for (const std::string& name : store::list_folder(folder)) store::remove_leftover(folder / name);
}

}  // namespace launchsafe::app
