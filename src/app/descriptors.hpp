// The three standard descriptors: there from the first line of main, and written to without exceptions.
#pragma once

#include <string_view>

namespace launchsafe::app {

/// Opens descriptors 0 to 2 where the caller closed them, so that no file of ours gets one of these numbers
/// and is written to as if it were stdout or stderr. To be called before anything else is opened. Writing to
/// a stdout that was closed still fails, so that lost results are noticed; a closed stderr swallows all.
void reserve_standard_descriptors();

/// Writes all of the text, waiting where the descriptor is a full pipe that does not block. 0, or the number
/// of the error that kept the rest from being written.
int write_all(int descriptor, std::string_view text);

/// For stderr: what cannot be written is dropped.
void write_or_drop(int descriptor, std::string_view text);

/// Errors that a file system only tells of when a descriptor is closed. 0, or the error's number; the
/// descriptor stays open.
int late_error_of(int descriptor);

}  // namespace launchsafe::app
