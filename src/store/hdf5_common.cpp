#include "hdf5_common.hpp"

#include <atomic>

namespace launchsafe::store {
namespace {

herr_t take_first(unsigned depth, const H5E_error2_t* entry, void* text) {
  if (depth == 0 && entry->desc != nullptr) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

}  // namespace

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string hdf5_reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &text);
  return text.empty() ? "unknown HDF5 error" : text;
}

Hdf5Id memory_access() {
  constexpr std::size_t growth = 1 << 20;
  Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (!access.valid() || H5Pset_fapl_core(access.get(), growth, false) < 0 ||
      // The oldest superblock has no checksum, which H5Fget_file_image would spoil by clearing the flags
      // beside it.
      H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) < 0) {
    return {};
  }
  return access;
}

std::string unique_name() {
  static std::atomic<std::uint64_t> count{0};
  return "memory " + std::to_string(count++);
}

Hdf5Id untimed(hid_t list_class) {
  Hdf5Id creation(H5Pcreate(list_class), H5Pclose);
  if (!creation.valid() || H5Pset_obj_track_times(creation.get(), false) < 0) return {};
  return creation;
}

Hdf5Id text_type(std::size_t bytes) {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (!type.valid() || H5Tset_size(type.get(), bytes) < 0 || H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0 ||
      H5Tset_strpad(type.get(), H5T_STR_NULLPAD) < 0) {
    return {};
  }
  return type;
}

std::string path_of(const std::vector<std::string>& groups, const std::string& name) {
  std::string path;
  for (const std::string& group : groups) path += "/" + group;
  return name.empty() && !path.empty() ? path : path + "/" + name;
}

Hdf5Step group_step(const std::string& name, const std::string& description) {
  return {{.name = name, .label = {"group", description}, .element_size = 0}, 0};
}

Hdf5Step attribute_step(const std::string& name, const std::string& text) {
  return {{.name = name, .label = {"attribute", text}, .element_size = 0}, 0};
}

Hdf5Step end_step() { return {{.name = "", .label = {"end", ""}, .element_size = 0}, 0}; }

}  // namespace launchsafe::store
