// Which model a result belongs to.
#pragma once

namespace launchsafe::run {

/// Raised by hand whenever the same scene gives other numbers than before. It is part of what determines a
/// stored case, so that results of different models are never mixed. The test ModelVersion.* fails when
/// numbers change and this did not.
inline constexpr int model_version = 7;

}  // namespace launchsafe::run
