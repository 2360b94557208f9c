#include "fuzz_input.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace launchsafe::fuzz {

std::vector<std::string> parts_of(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view separator = "\n%%%%\n";
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> parts;
  for (std::size_t at = rest.find(separator); at != std::string_view::npos; at = rest.find(separator)) {
    parts.emplace_back(rest.substr(0, at));
    rest.remove_prefix(at + separator.size());
  }
  parts.emplace_back(rest);
  return parts;
}

void require(bool holds, std::string_view what, std::string_view detail) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %.*s\n%.*s\n", static_cast<int>(what.size()), what.data(),
               static_cast<int>(detail.size()), detail.data());
  std::abort();
}

void require_told(const scene::InputError& error) {
  require(!error.file.empty() && !error.found.empty() && !error.allowed.empty(),
          "an error names file, what was found and what is allowed", error.message());
  require(error.line >= 0 && error.column >= 0, "an error has a place", error.message());
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "launchsafe_fuzz_XXXXXX").string();
  require(mkdtemp(name.data()) != nullptr, "a temporary folder can be made", name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void ScratchFolder::write(const std::string& name, const std::string& text) {
  auto file =
      std::find_if(written_.begin(), written_.end(), [&](const Written& each) { return each.name == name; });
  if (file != written_.end() && file->text == text) return;
  if (file == written_.end()) file = written_.insert(file, {name, {}});
  std::ofstream stream(path_ / name, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  require(stream.good(), "a temporary file can be written", name);
  file->text = text;
}

void ScratchFolder::remove(const std::string& name) {
  const auto file =
      std::find_if(written_.begin(), written_.end(), [&](const Written& each) { return each.name == name; });
  if (file == written_.end()) return;
  std::filesystem::remove(path_ / name);
  written_.erase(file);
}

}  // namespace launchsafe::fuzz
