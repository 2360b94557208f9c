// What the fuzzers of the readers have in common.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::fuzz {

/// The parts of an input, which lines "%%%%" separate; always at least one.
std::vector<std::string> parts_of(const std::uint8_t* data, std::size_t size);

/// Ends the process with a report, which the fuzzer takes for a crash, unless `holds`.
void require(bool holds, std::string_view what, std::string_view detail = {});

/// Requires that an error says where, what was found and what is allowed.
void require_told(const scene::InputError& error);

/// A folder of this process, removed at its end. Files in it are only written when they change.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text);
  void remove(const std::string& name);

 private:
  struct Written {
    std::string name, text;
  };
  std::filesystem::path path_;
  std::vector<Written> written_;
};

}  // namespace launchsafe::fuzz
