// Studies from any bytes. An input is the text of a study and, after a line "%%%%", that of its scene,
// scene.toml. Whatever is read must have cases fit to be computed; whatever is not must say why.
#include "fuzz_input.hpp"
#include "launchsafe/kinds/kind.hpp"

#include <fstream>
#include <iterator>

namespace {

using namespace launchsafe;

void check_case(const study::StudyCase& each) {
  const std::string written = scene::to_toml(each.scene.scene);
  const auto again = scene::caught([&] { return scene::parse_scene(written, "written.toml"); });
  fuzz::require(again.has_value(), "the scene of a case can be written and read",
                again ? std::string{} : again.error().message() + "\n" + written);
  fuzz::require(scene::to_toml(again->scene) == written, "a case is the scene that is written", written);
  fuzz::require(!each.label.empty(), "a case has a label", written);
}

void check_study(const study::StudyFile& file) {
  if (file.study.kind.own_scenes) return;  // its cases may be laws without a scene
  fuzz::require(!file.cases.empty(), "a study has cases");
  check_case(file.cases.front());
  check_case(file.cases.back());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::ScratchFolder folder;
  static const std::string usual_scene = [] {
    std::ifstream stream(LAUNCHSAFE_FUZZ_SCENE, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }();
  const auto parts = fuzz::parts_of(data, size);
  folder.write("scene.toml", parts.size() > 1 ? parts[1] : usual_scene);
  kinds::StudyRequest request;
  request.most_cases = 400;  // more only take longer
  const auto file = kinds::parse_study(parts[0], folder.path() / "study.toml", request);
  file ? check_study(*file) : fuzz::require_told(file.error());
  return 0;
}
