// Writing many values into one text.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"

#include <fmt/format.h>

namespace launchsafe::scene {

/// Appends what `exact_toml` returns.
void append_exact_toml(fmt::memory_buffer& text, const KeyDescription& key, const Value& value);

inline void append(fmt::memory_buffer& text, std::string_view more) {
  text.append(more.data(), more.data() + more.size());
}

}  // namespace launchsafe::scene
