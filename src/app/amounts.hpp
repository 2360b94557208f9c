// Amounts on the command line: sizes of memory, durations, temperatures.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace launchsafe::app {

/// Bytes: "8GB", "500 MB", "1.5GiB", "8e9". kB, MB, GB and TB are powers of 1000; KiB, MiB, GiB and TiB of
/// 1024. Nothing for any other text, and for less than a byte or more than 1e18.
std::optional<double> parse_size(std::string_view text);
inline constexpr const char* allowed_sizes = "a size such as 500MB, 8GB, 1.5GiB or 8e9, up to 1e18";

/// Seconds: "90s", "10min", "2h", "1.5 d", "90". Nothing for any other text, and for what is not more than
/// zero.
std::optional<double> parse_duration(std::string_view text);
inline constexpr const char* allowed_durations = "a duration such as 90s, 10min, 2h or 1d";

/// K: "2K", "0.5 K", "2". Nothing for any other text, and for what is not more than zero.
std::optional<double> parse_temperature(std::string_view text);
inline constexpr const char* allowed_temperatures = "a temperature difference such as 2K or 0.5K";

}  // namespace launchsafe::app
