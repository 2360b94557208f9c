#include "launchsafe/store/case_file.hpp"

#include "case_layout.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "xdmf.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace launchsafe::store {
namespace {

constexpr std::string_view format_name = "launchsafe case file";
constexpr std::string_view format_version = "1";

// --- the user block: what the bytes after it must be ---

constexpr std::size_t user_block_size = 512;
constexpr std::string_view size_mark = "\nbytes ";
constexpr std::string_view digest_mark = "\nsha256 ";

std::string user_block(std::string_view image) {
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

/// The HDF5 image inside a case file's bytes. Errors: corrupt.
Result<std::string_view> checked_image(std::string_view file) {
  const auto corrupt = [](std::string message) { return Error{Error::Kind::corrupt, std::move(message)}; };
  const std::string_view block = file.substr(0, user_block_size);
  if (!block.starts_with(format_name)) return corrupt("not a launchsafe case file");
  if (block.size() < user_block_size) return corrupt("truncated in its first block");
  const std::string_view image = file.substr(user_block_size);
  const std::string_view size_text = word_after(block, size_mark);
  std::size_t size = 0;
  std::from_chars(size_text.data(), size_text.data() + size_text.size(), size);
  if (image.size() != size) return corrupt(fmt::format("truncated: {} of {} bytes", image.size(), size));
  if (word_after(block, digest_mark) != sha256(image)) return corrupt("damaged: its SHA-256 is another one");
  return image;
}

// --- the parts that only writing knows ---

template <class Value>
std::string name_of(Value value, std::initializer_list<Named<Value>> names) {
  for (const auto& each : names) {
    if (each.value == value) return each.name;
  }
  return "unknown";
}

void write_bodies(Hdf5Writer& writer, const std::vector<scene::Body>& bodies) {
  using scene::Body, scene::BodyMaterial;
  column(writer, "name", bodies, &Body::name, {"none", "name"});
  const auto material = [](const Body& body) {
    return name_of<BodyMaterial>(body.material,
                                 {{BodyMaterial::steel, "steel"}, {BodyMaterial::charge, "charge"}});
  };
  column(writer, "material", bodies, material, {"none", "material"});
  column(writer, "x_begin", bodies, &Body::x_begin, {"m", "axial begin"});
  column(writer, "x_end", bodies, &Body::x_end, {"m", "axial end"});
  column(writer, "r_begin", bodies, &Body::r_begin, {"m", "radial begin"});
  column(writer, "r_end", bodies, &Body::r_end, {"m", "radial end"});
}

void write_scene(Hdf5Writer& writer, const scene::Scene& scene) {
  using scene::ObservationPoint, scene::Symmetry, scene::Frame;
  writer.group("scene", "What was simulated; complete in manifest/input", [&] {
    writer.value("title", scene.title, {"none", "title"});
    writer.value("symmetry",
                 name_of<Symmetry>(scene.symmetry, {{Symmetry::axisymmetric, "axisymmetric"},
                                                    {Symmetry::plane_strain, "plane_strain"}}),
                 {"none", "symmetry"});
    writer.value("frame", name_of<Frame>(scene.frame, {{Frame::co_moving, "co_moving"}, {Frame::lab, "lab"}}),
                 {"none", "frame of reference"});
    writer.value("initial_temperature", scene.initial_temperature, {"K", "initial temperature"});
    writer.value("peak_pressure", scene.load.peak, {"Pa", "peak chamber pressure"});
    writer.value("cell_size", scene.numerics.cell_size, {"m", "nominal cell size"});
    writer.group("bodies", "Bodies", [&] { write_bodies(writer, scene.bodies); });
    writer.group("observation_points", "Observation points", [&] {
      const auto& points = scene.output.observation_points;
      column(writer, "name", points, &ObservationPoint::name, {"none", "name"});
      column(writer, "x", points, &ObservationPoint::x, {"m", "axial position"});
      column(writer, "r", points, &ObservationPoint::r, {"m", "radial position"});
    });
  });
}

Result<std::string> image_of(const scene::Scene& scene, const run::CaseResult& result,
                             const Manifest& manifest) {
  Hdf5Writer writer;
  writer.attribute("format", std::string(format_name));
  writer.attribute("format_version", std::string(format_version));
  lay_out_manifest(writer, manifest);
  write_scene(writer, scene);
  lay_out_result(writer, result);
  return writer.finish();
}

/// Nothing when `path` is free or holds an answer to the same question.
MaybeError conflict_at(const std::filesystem::path& path, const Manifest& manifest) {
  const Result<Manifest> present = read_manifest(path);
  if (!present) {
    if (present.error().kind == Error::Kind::missing) return {};
    return present.error();
  }
  if (present->input_sha256 == manifest.input_sha256) return {};
  return Error{Error::Kind::conflict,
               fmt::format("{} holds the result of a different input (SHA-256 {:.12}..., not "
                           "{:.12}...); it was left as it is",
                           path.string(), present->input_sha256, manifest.input_sha256)};
}

MaybeError publish(const std::filesystem::path& path, std::string_view image, const Manifest& manifest) {
  const std::string block = user_block(image);
  if (const MaybeError conflict = conflict_at(path, manifest)) return conflict;
  const MaybeError error = write_file_atomically(path, {block, image}, IfExists::refuse);
  if (!error || error->kind != Error::Kind::conflict) return error;
  // Something is there: the same question's answer before, or since a moment ago by another process.
  if (const MaybeError conflict = conflict_at(path, manifest)) return conflict;
  return write_file_atomically(path, {block, image}, IfExists::replace);
}

/// Runs `body` on a reader of the file at `path`. Errors: missing, unreadable, corrupt.
template <class Body>
MaybeError read_with(const std::filesystem::path& path, Body body) {
  const Result<std::string> file = read_file(path);
  if (!file) return file.error();
  const auto located = [&path](const Error& error) {
    return Error{error.kind, fmt::format("{}: {}", path.string(), error.message)};
  };
  const Result<std::string_view> image = checked_image(*file);
  if (!image) return located(image.error());
  Hdf5Reader reader(*image);
  std::string version;
  reader.attribute("format_version", version);
  if (!reader.failed() && version != format_version) reader.fail("format version " + version + " is unknown");
  body(reader);
  if (reader.failed()) return located(*reader.error());
  return {};
}

}  // namespace

MaybeError write_case_file(const std::filesystem::path& path, const scene::Scene& scene,
                           const run::CaseResult& result, const Manifest& manifest) {
  const Result<std::string> image = image_of(scene, result, manifest);
  if (!image) {
    return Error{image.error().kind,
                 fmt::format("cannot write {}: {}", path.string(), image.error().message)};
  }
  if (MaybeError error = publish(path, *image, manifest)) return error;
  const auto& snapshots = result.mechanics.snapshots;
  if (snapshots.empty()) return {};
  const std::filesystem::path sidecar = std::filesystem::path(path).replace_extension(".xdmf");
  return write_file_atomically(sidecar, {xdmf_of(snapshots, path.filename().string())});
}

Result<StoredCase> read_case_file(const std::filesystem::path& path) {
  StoredCase stored;
  const MaybeError error = read_with(path, [&stored](Hdf5Reader& reader) {
    lay_out_manifest(reader, stored.manifest);
    reader.group("scene", "", [&] { reader.value("title", stored.title); });
    lay_out_result(reader, stored.result);
  });
  if (error) return *error;
  return stored;
}

Result<Manifest> read_manifest(const std::filesystem::path& path) {
  Manifest manifest;
  const MaybeError error =
      read_with(path, [&manifest](Hdf5Reader& reader) { lay_out_manifest(reader, manifest); });
  if (error) return *error;
  return manifest;
}

}  // namespace launchsafe::store
