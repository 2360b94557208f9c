#include "launchsafe/store/case_file.hpp"

#include "case_layout.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "posix_file.hpp"

#include <charconv>

namespace launchsafe::store {
namespace {

constexpr std::string_view format_name = case_file_begin;
constexpr std::string_view format_version = "1";

// --- the user block: what the bytes after it must be ---

constexpr std::size_t user_block_size = 512;
constexpr std::string_view size_mark = "\nbytes ";
constexpr std::string_view digest_mark = "\nsha256 ";

std::string user_block_of(std::string_view image) {
  std::string block = fmt::format("{} {}{}{}{}{}\n", format_name, format_version, size_mark, image.size(),
                                  digest_mark, sha256(image));
  block.resize(user_block_size, ' ');
  block.back() = '\n';
  return block;
}

std::string_view word_after(std::string_view text, std::string_view mark) {
  const std::size_t found = text.find(mark);
  if (found == std::string_view::npos) return {};
  const std::string_view rest = text.substr(found + mark.size());
  return rest.substr(0, rest.find('\n'));
}

/// The HDF5 image inside a case file's bytes. Throws where they are damaged.
std::string_view checked_image(std::string_view file) {
  const auto corrupt = [](std::string message) { return Error{Error::Kind::corrupt, std::move(message)}; };
  const std::string_view block = file.substr(0, user_block_size);
  if (!block.starts_with(format_name)) throw corrupt("not a launchsafe case file");
  if (block.size() < user_block_size) throw corrupt("truncated in its first block");
  const std::string_view image = file.substr(user_block_size);
  const std::string_view size_text = word_after(block, size_mark);
  std::size_t size = 0;
  std::from_chars(size_text.data(), size_text.data() + size_text.size(), size);
  if (image.size() != size) throw corrupt(fmt::format("truncated: {} of {} bytes", image.size(), size));
  if (word_after(block, digest_mark) != sha256(image)) throw corrupt("damaged: its SHA-256 is another one");
  return image;
}

// --- what lies in the image ---

template <class Archive, class Title>
void lay_out_title(Archive& archive, Title& title) {
  archive.group("scene", "What was simulated is in manifest/input", [&] {
    archive.value("title", title, {"none", "title"});
  });
}

/// A reader of the image in a case file's bytes. Throws where it is none.
Hdf5Reader reader_of(std::string_view bytes) {
  Hdf5Reader reader(checked_image(bytes));
  std::string version;
  reader.attribute("format_version", version);
  if (version != format_version) reader.fail("format version " + version + " is unknown");
  return reader;
}

// --- whether a result that was read can have come from a run ---

using trace::BottomTrace;

/// Whether times are finite and each is later than the one before.
bool increase(const std::vector<double>& times) {
  return math::all_finite(times) && std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end();
}

std::string fault_in_trace(const BottomTrace& trace, bool completed) {
  if (!increase(trace.time)) return "the times of the trace do not increase";
  if (!completed) return {};
  for (const auto* history : {&trace.chamber_pressure, &trace.bottom_pressure, &trace.mean_chamber_pressure,
                              &trace.mean_bottom_pressure}) {
    if (history->size() != trace.samples()) return "a history of the completed run is cut short";
    if (!math::all_finite(*history)) return "a history of the completed run holds what is no number";
  }
  for (const auto& friction : trace.friction)
    if (!math::all_finite(friction)) return "the friction of the completed run holds what is no number";
  return {};
}

std::string fault_in_gap(const run::GapResult& gap, const BottomTrace& trace) {
  if (!(gap.gap >= 0.0) || gap.gap != gap.skin.gap) return "a gap is none";
  if (!increase(gap.skin.time)) return "the times of a skin do not increase";
  if (gap.sampling_error < 0.0) return "an error is negative";
  const std::size_t stations = trace.stations.size();
  const auto is_absent = [stations](const auto& place) { return place && place->station >= stations; };
  if (is_absent(gap.skin.ignition)) return "an ignition is nowhere";
  if (gap.skin.ignition && trace.stations[gap.skin.ignition->station].observation)
    return "an ignition is not at a station";
  return {};
}

/// What contradicts itself in a result: times that do not increase, histories of a completed run that are cut
/// short or hold what is no number, places that are not there. Empty for nothing. That a result says what a
/// run came to is what its checksum is for.
std::string fault_in(const run::CaseResult& result) {
  const run::MechanicsResult& mechanics = result.mechanics;
  const bool completed = mechanics.status == run::RunStatus::completed;
  if (!(mechanics.end_time >= 0.0)) return "the time reached is none";
  if (std::string fault = fault_in_trace(mechanics.trace, completed); !fault.empty()) return fault;
  for (const run::GapResult& gap : result.gaps)
    if (std::string fault = fault_in_gap(gap, mechanics.trace); !fault.empty()) return fault;
  return {};
}

// --- files ---

MaybeError publish(const std::filesystem::path& path, std::string_view bytes, const Manifest& manifest) {
  if (const MaybeError conflict = obstacle_to_case_file(path, manifest)) return conflict;
  const MaybeError error = write_file_atomically(path, bytes, IfExists::refuse);
  if (!error || error->kind != Error::Kind::conflict) return error;
  // Something is there: the same question's answer before, or since a moment ago by another process.
  if (const MaybeError conflict = obstacle_to_case_file(path, manifest)) return conflict;
  return write_file_atomically(path, bytes, IfExists::replace);
}

/// What `parse` makes of the file at `path`. Errors: missing, unreadable, corrupt.
template <class Value>
Result<Value> read_with(const std::filesystem::path& path, Result<Value> (*parse)(std::string_view)) {
  const Result<std::string> file = read_file(path);
  if (!file) return file.error();
  Result<Value> value = parse(*file);
  return value ? value : of_file(path, value.error());
}

Result<Manifest> manifest_of(std::string_view bytes) try {
  Hdf5Reader reader = reader_of(bytes);
  Manifest manifest;
  lay_out_manifest(reader, manifest);
  return manifest;
} catch (const Error& error) {
  return error;
}

}  // namespace

Result<std::string> case_bytes(const scene::Scene& scene, const run::CaseResult& result,
                               const Manifest& manifest) try {
  Hdf5Writer writer;
  writer.attribute("format", std::string(format_name));
  writer.attribute("format_version", std::string(format_version));
  lay_out_manifest(writer, manifest);
  lay_out_title(writer, scene.title);
  lay_out_result(writer, result);
  const std::string image = writer.finish();
  return user_block_of(image) + image;
} catch (const Error& error) {
  return error;
}

Result<StoredCase> case_of(std::string_view bytes) try {
  Hdf5Reader reader = reader_of(bytes);
  StoredCase stored;
  lay_out_manifest(reader, stored.manifest);
  lay_out_title(reader, stored.title);
  lay_out_result(reader, stored.result);
  if (const std::string fault = fault_in(stored.result); !fault.empty()) reader.fail(fault);
  return stored;
} catch (const Error& error) {
  return error;
}

MaybeError write_case_file(const std::filesystem::path& path, const scene::Scene& scene,
                           const run::CaseResult& result, const Manifest& manifest) {
  const Result<std::string> bytes = case_bytes(scene, result, manifest);
  if (!bytes)
    return Error{bytes.error().kind,
                 fmt::format("cannot write {}: {}", path.string(), bytes.error().message)};
  const bool burns = std::ranges::any_of(result.gaps, [](const run::GapResult& gap) {
    return gap.combustion && !gap.combustion->snapshots.empty();
  });
  const bool has_sidecar = burns || !result.mechanics.snapshots.empty();
  const MaybeError obstacle = has_sidecar ? obstacle_to_sidecar(path) : MaybeError();
  if (obstacle) return obstacle;
  if (MaybeError error = publish(path, *bytes, manifest)) return error;
  if (!has_sidecar) return {};
  return write_file_atomically(sidecar_of(path), xdmf_of(result, path.filename().string()),
                               IfExists::replace);
}

std::filesystem::path sidecar_of(const std::filesystem::path& path) {
  return std::filesystem::path(path).replace_extension(".xdmf");
}

MaybeError obstacle_to_case_file(const std::filesystem::path& path, const Manifest& manifest) {
  std::error_code failed;
  if (std::filesystem::is_symlink(path, failed)) return refusal(path, "is a link");
  const Result<Manifest> present = read_manifest(path);
  if (present && present->input_sha256 == manifest.input_sha256) return {};
  if (present) return refusal(path, "holds the result of a different input");
  if (present.error().kind == Error::Kind::missing) return {};
  return Error{present.error().kind,
               present.error().message + "; it is not overwritten: move it away or name another folder"};
}

MaybeError obstacle_to_sidecar(const std::filesystem::path& path) {
  const std::filesystem::path sidecar = sidecar_of(path);
  std::error_code failed;
  const auto status = std::filesystem::symlink_status(sidecar, failed);
  if (!std::filesystem::exists(status)) return {};
  const Result<StoredCase> stored = read_case_file(path);
  const Result<std::string> text = read_file(sidecar);
  if (std::filesystem::is_regular_file(status) && stored && text &&
      *text == xdmf_of(stored->result, path.filename().string()))
    return {};
  return refusal(sidecar, "is not what launchsafe writes beside that case");
}

Result<StoredCase> read_case_file(const std::filesystem::path& path) { return read_with(path, case_of); }

Result<CaseWithScene> read_case_with_scene(const std::filesystem::path& path) {
  Result<StoredCase> stored = read_case_file(path);
  if (!stored) return stored.error();
  auto file = scene::parse_scene(stored->manifest.input_text, path);
  if (!file)
    return Error{Error::Kind::corrupt, fmt::format("{}: its input is no scene to this program: {}",
                                                   path.string(), file.error().message())};
  return CaseWithScene{std::move(*stored), std::move(file->scene)};
}

Result<Manifest> read_manifest(const std::filesystem::path& path) { return read_with(path, manifest_of); }

}  // namespace launchsafe::store
