#include "launchsafe/store/case_file.hpp"

#include "launchsafe/version.hpp"
#include "layout.hpp"

#include <fmt/chrono.h>

#include <ctime>

namespace launchsafe::store {
namespace {

constexpr std::size_t user_block_size = 512;
constexpr std::string_view format = "launchsafe case file 2\n";

/// What the bytes of a case file begin with; the rest is the image.
std::string user_block_of(std::string_view image) {
  std::string block = fmt::format("{}bytes {}\nsha256 {}\n", format, image.size(), sha256(image));
  block.resize(user_block_size, ' ');
  block.back() = '\n';
  return block;
}

}  // namespace

std::filesystem::path sidecar_of(const std::filesystem::path& path) {
  return std::filesystem::path(path).replace_extension(".xdmf");
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string program_of(const Manifest& manifest) {
  return fmt::format("launchsafe {}, commit {}", manifest.program_version, manifest.commit);
}

Manifest make_manifest(std::string input_text) {
  Manifest manifest{.input_text = std::move(input_text), .model_version = run::model_version};
  manifest.input_sha256 = sha256(manifest.input_text);
  manifest.program_version = version::number;
  manifest.commit = version::commit;
  manifest.compiler = version::compiler;
  manifest.compiler_flags = version::flags;
  manifest.build_type = version::build_type;
  manifest.start_time = utc_now();
  return manifest;
}

std::string case_bytes(const StoredCase& stored) {
  StoredCase& read = const_cast<StoredCase&>(stored);  // a file that is written changes nothing
  Hdf5 file;
  members(file, "manifest/", read.manifest, manifest_members);
  lay_out(file, read.result);
  const std::string image = file.finish();
  return user_block_of(image) + image;
}

StoredCase read_case_file(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  try {
    const std::string_view image = std::string_view(bytes).substr(std::min(user_block_size, bytes.size()));
    if (!bytes.starts_with(format))
      throw Error{Error::Kind::corrupt, "not a case file of this version of launchsafe"};
    if (!bytes.starts_with(user_block_of(image)))
      throw Error{Error::Kind::corrupt, "damaged: its SHA-256 is another one"};
    Hdf5 file(image);
    StoredCase stored;
    members(file, "manifest/", stored.manifest, manifest_members);
    lay_out(file, stored.result);
    return stored;
  } catch (const Error& error) {
    throw Error{error.kind, fmt::format("{}: {}", path.string(), error.message)};
  }
}

void write_case_file(const std::filesystem::path& path, const StoredCase& stored) {
  const run::CaseResult& result = stored.result;
  const bool burns = std::ranges::any_of(result.gaps, [](const run::GapResult& gap) {
    return gap.combustion && !gap.combustion->snapshots.empty();
  });
  write_file_atomically(path, case_bytes(stored), IfExists::refuse);
  if (burns || !result.mechanics.snapshots.empty())
    write_file_atomically(sidecar_of(path), xdmf_of(result, path.filename().string()), IfExists::refuse);
}

}  // namespace launchsafe::store
