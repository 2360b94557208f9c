#include "case_bytes.hpp"

#include "case_layout.hpp"
#include "case_soundness.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>

#include <charconv>

namespace launchsafe::store {
namespace {

constexpr std::string_view format_name = "launchsafe case file";
constexpr std::string_view format_version = "1";

// --- the user block: what the bytes after it must be ---

constexpr std::size_t user_block_size = 512;
constexpr std::string_view size_mark = "\nbytes ";
constexpr std::string_view digest_mark = "\nsha256 ";

/// Fills the block in front of the image.
void fill_user_block(std::string& file) {
  const std::string_view image = std::string_view(file).substr(user_block_size);
  std::string block = fmt::format("{} {}{}{}{}{}\n", format_name, format_version, size_mark, image.size(),
                                  digest_mark, sha256(image));
  block.resize(user_block_size, ' ');
  block.back() = '\n';
  block.copy(file.data(), block.size());
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

void write_bodies(Hdf5Output& output, const std::vector<scene::Body>& bodies) {
  using scene::Body;
  column(output, "name", bodies, &Body::name, {"none", "name"});
  column(output, "material", bodies, &Body::material, {"none", "material"});
  column(output, "x_begin", bodies, &Body::x_begin, {"m", "axial begin"});
  column(output, "x_end", bodies, &Body::x_end, {"m", "axial end"});
  column(output, "r_begin", bodies, &Body::r_begin, {"m", "radial begin"});
  column(output, "r_end", bodies, &Body::r_end, {"m", "radial end"});
}

void write_scene(Hdf5Output& output, const scene::Scene& scene) {
  using scene::ObservationPoint, scene::Symmetry, scene::Frame;
  output.group("scene", "What was simulated; complete in manifest/input", [&] {
    output.value("title", scene.title, {"none", "title"});
    output.value("symmetry",
                 name_of<Symmetry>(scene.symmetry, {{Symmetry::axisymmetric, "axisymmetric"},
                                                    {Symmetry::plane_strain, "plane_strain"}}),
                 {"none", "symmetry"});
    output.value("frame", name_of<Frame>(scene.frame, {{Frame::co_moving, "co_moving"}, {Frame::lab, "lab"}}),
                 {"none", "frame of reference"});
    output.value("initial_temperature", scene.initial_temperature, {"K", "initial temperature"});
    output.value("peak_pressure", scene.load.peak, {"Pa", "peak chamber pressure"});
    output.value("cell_size", scene.numerics.cell_size, {"m", "nominal cell size"});
    output.group("bodies", "Bodies", [&] { write_bodies(output, scene.bodies); });
    output.group("observation_points", "Observation points", [&] {
      const auto& points = scene.output.observation_points;
      column(output, "name", points, &ObservationPoint::name, {"none", "name"});
      column(output, "x", points, &ObservationPoint::x, {"m", "axial position"});
      column(output, "r", points, &ObservationPoint::r, {"m", "radial position"});
    });
  });
}

template <class LayOut>
Result<std::string> written_file(std::size_t room_in_front, const LayOut& lay_out) {
  Hdf5Writer writer;
  lay_out(writer);
  return writer.finish(room_in_front);
}

/// Runs `body` on a reader of the image in a case file's bytes. Errors: corrupt.
template <class Body>
MaybeError read_with(std::string_view bytes, Body body) {
  const Result<std::string_view> image = checked_image(bytes);
  if (!image) return image.error();
  Hdf5Reader reader(*image);
  std::string version;
  reader.attribute("format_version", version);
  if (!reader.failed() && version != format_version) reader.fail("format version " + version + " is unknown");
  body(reader);
  return reader.error();
}

}  // namespace

Result<std::string> case_bytes(const scene::Scene& scene, const run::CaseResult& result,
                               const Manifest& manifest, Hdf5Molds* molds) {
  const auto lay_out = [&](Hdf5Output& output) {
    output.attribute("format", std::string(format_name));
    output.attribute("format_version", std::string(format_version));
    lay_out_manifest(output, manifest);
    write_scene(output, scene);
    lay_out_result(output, result);
  };
  Result<std::string> file =
      molds != nullptr ? molds->file_of(user_block_size, lay_out) : written_file(user_block_size, lay_out);
  if (file) fill_user_block(*file);
  return file;
}

Result<StoredCase> case_of(std::string_view bytes) {
  StoredCase stored;
  const MaybeError error = read_with(bytes, [&stored](Hdf5Reader& reader) {
    lay_out_manifest(reader, stored.manifest);
    reader.group("scene", "", [&] { reader.value("title", stored.title); });
    lay_out_result(reader, stored.result);
    if (reader.failed()) return;
    if (const std::string fault = fault_in(stored.result); !fault.empty()) reader.fail(fault);
  });
  if (error) return *error;
  return stored;
}

Result<Manifest> manifest_of(std::string_view bytes) {
  Manifest manifest;
  const MaybeError error =
      read_with(bytes, [&manifest](Hdf5Reader& reader) { lay_out_manifest(reader, manifest); });
  if (error) return *error;
  return manifest;
}

}  // namespace launchsafe::store
