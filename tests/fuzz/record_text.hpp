// Accuracy records that a fuzzer changed, with the digests that it cannot guess.
#pragma once

#include "launchsafe/store/sha256.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace launchsafe::fuzz {

/// The text with its "digest" that of the rest; as it is where it is no JSON object. Numbers stay as they are
/// written, so that only those as the program writes them have the right digest.
inline std::string with_digest(const std::string& text) {
  auto record = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!record.is_object()) return text;
  record.erase("digest");
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  record["digest"] = store::sha256(record.dump(-1, ' ', false, replace));
  return record.dump(2, ' ', false, replace);
}

}  // namespace launchsafe::fuzz
