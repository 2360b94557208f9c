// What writing and reading HDF5 share.
#pragma once

#include "launchsafe/store/hdf5.hpp"

#include <hdf5.h>

#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

namespace launchsafe::store {

/// HDF5 prints its errors on stderr unless told otherwise, in every thread anew.
void silence_hdf5();

/// The innermost cause on this thread's HDF5 error stack, such as "unable to open object".
std::string hdf5_reason();

/// An access list whose files live in memory alone.
Hdf5Id memory_access();

/// A name for a file in memory. HDF5 takes two open ones of the same name for the same file.
std::string unique_name();

/// A creation list (of H5P_DATASET_CREATE or H5P_GROUP_CREATE) without time stamps: the same content gives
/// the same bytes.
Hdf5Id untimed(hid_t list_class);

/// A fixed-length text type (UTF-8, padded with zeros).
Hdf5Id text_type(std::size_t bytes);

/// "/trace/stations" of the names of nested groups, and the dataset in the last.
std::string path_of(const std::vector<std::string>& groups, const std::string& name);

/// What is no dataset, as steps that are told from datasets by their size.
Hdf5Step group_step(const std::string& name, const std::string& description);
Hdf5Step attribute_step(const std::string& name, const std::string& text);
Hdf5Step end_step();

template <class T>
hid_t memory_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
  return H5T_NATIVE_UINT64;
}

}  // namespace launchsafe::store
