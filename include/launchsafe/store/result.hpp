// Errors of files and programs as values.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <filesystem>

namespace launchsafe::store {

/// What went wrong, for a person (`message` names the file), and its kind, for the caller's decision.
struct Error {
  enum class Kind {
    missing,       ///< there is no such file or program
    unreadable,    ///< it is there and could not be read (permission, device)
    corrupt,       ///< truncated, damaged, or not of this format: set it aside and compute again
    held,          ///< another process writes it
    conflict,      ///< a different result is already there; nothing was written
    write_failed,  ///< nothing was written under the target name
    failed         ///< a program that was called failed
  };
  Kind kind = Kind::failed;
  std::string message;
};

/// Empty when all went well.
using MaybeError = std::optional<Error>;

/// A value, or the reason why there is none.
template <class T>
using Result = scene::Expected<T, Error>;

}  // namespace launchsafe::store
