// The bytes of a case file: a block that says what must follow, then the HDF5 image.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/hdf5_mold.hpp"

#include <string>
#include <string_view>

namespace launchsafe::store {

/// A whole case file; `molds` make it cheap where there were cases of the same shape. Errors: failed (a
/// result whose arrays do not fit together).
Result<std::string> case_bytes(const scene::Scene& scene, const run::CaseResult& result,
                               const Manifest& manifest, Hdf5Molds* molds = nullptr);

/// What `case_bytes` was given but the scene. Errors: corrupt.
Result<StoredCase> case_of(std::string_view bytes);

/// The manifest alone; all bytes are checked all the same. Errors: corrupt.
Result<Manifest> manifest_of(std::string_view bytes);

}  // namespace launchsafe::store
