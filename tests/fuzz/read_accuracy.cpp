// Accuracy records from any bytes: whatever is not read must say why.
#include "fuzz_input.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/accuracy_record.hpp"
#include "record_text.hpp"

#include <fstream>
#include <iterator>

namespace {

using namespace launchsafe;

void read(const std::string& text) {
  const auto record = study::parse_accuracy_record(text, "accuracy.json");
  if (!record) fuzz::require_told(record.error());
}

const std::string& small_scene() {
  static const std::string text = [] {
    std::ifstream stream(LAUNCHSAFE_FUZZ_SCENE, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }();
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  read(fuzz::with_scene(text, small_scene()));
  return 0;
}
