#include "launchsafe/store/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::store {
namespace {

/// An access list for files that live in memory alone.
hid_t memory_access() {
  // HDF5 prints its errors on stderr unless told otherwise, in every thread anew.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 20, false);
  // The oldest superblock has no checksum, which H5Fget_file_image would spoil by clearing the flags beside
  // it.
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  return access;
}

/// Made once, and never closed.
struct Library {
  const hid_t untimed = H5Pcreate(H5P_DATASET_CREATE);   ///< without time stamps: equal values, equal bytes
  const hid_t with_groups = H5Pcreate(H5P_LINK_CREATE);  ///< makes the groups on the path of a name
  const hid_t text = H5Tcopy(H5T_C_S1);                  ///< UTF-8 of any length
  const hid_t scalar = H5Screate(H5S_SCALAR);
  Library() {
    H5Pset_obj_track_times(untimed, false);
    H5Pset_create_intermediate_group(with_groups, 1);
    H5Tset_size(text, H5T_VARIABLE);
    H5Tset_cset(text, H5T_CSET_UTF8);
  }
};
const Library& library() {
  static const Library made;
  return made;
}

/// A name for a file in memory. HDF5 takes two open ones of the same name for the same file.
std::string unique_name() {
  static std::atomic<std::uint64_t> count{0};
  return fmt::format("memory {}", count++);
}

}  // namespace

Hdf5::Hdf5() : reading_(false) {
  const hid_t access = memory_access();
  file_ = H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  check(file_, "a file");
}

Hdf5::Hdf5(std::string_view image) : reading_(true) {
  const hid_t access = memory_access();
  // HDF5 copies the image; its signature lacks the const.
  H5Pset_file_image(access, const_cast<char*>(image.data()), image.size());
  if (!image.empty()) file_ = H5Fopen(unique_name().c_str(), H5F_ACC_RDONLY, access);
  H5Pclose(access);
  check(file_, "the file");
}

Hdf5::~Hdf5() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5::fail(const std::string& what) const {
  throw Error{reading_ ? Error::Kind::corrupt : Error::Kind::failed, what};
}

hid_t Hdf5::check(hid_t result, const std::string& name) const {
  if (result < 0) fail(name + " cannot be read or written as HDF5");
  return result;
}

bool Hdf5::has(const std::string& name) const { return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0; }

std::size_t Hdf5::size(const std::string& group) const {
  H5G_info_t info{};
  return H5Gget_info_by_name(file_, group.c_str(), &info, H5P_DEFAULT) < 0 ? 0 : info.nlinks;
}

void Hdf5::exchange(const std::string& name, const char* unit, hid_t type, Extent extent,
                    const std::function<void*(const Extent&)>& place) const {
  hid_t set = -1, space = -1;
  if (reading_) {
    set = check(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), name);
    space = H5Dget_space(set);
    const hid_t stored = H5Dget_type(set);
    const bool fits = H5Tget_class(stored) == H5Tget_class(type) &&
                      H5Sget_simple_extent_ndims(space) == static_cast<int>(extent.size());
    H5Tclose(stored);
    if (!fits) fail(name + " has another type or number of dimensions");
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  } else {
    const auto& [untimed, with_groups, text, scalar] = library();
    space = extent.empty() ? H5Scopy(scalar)
                           : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    set = check(H5Dcreate2(file_, name.c_str(), type, space, with_groups, untimed, H5P_DEFAULT), name);
    const hid_t attribute = H5Acreate2(set, "units", text, scalar, H5P_DEFAULT, H5P_DEFAULT);
    check(H5Awrite(attribute, text, &unit), name);
    H5Aclose(attribute);
  }
  void* const values = place(extent);
  if (std::ranges::find(extent, hsize_t{0}) == extent.end())
    check(reading_ ? H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values)
                   : H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
          name);
  H5Sclose(space);
  H5Dclose(set);
}

void Hdf5::texts(const std::string& name, std::vector<std::string>& texts, const char* unit,
                 Extent extent) const {
  std::vector<char*> places;
  for (std::string& text : texts) places.push_back(text.data());
  exchange(name, unit, library().text, std::move(extent), [&](const Extent& stored) {
    if (reading_) places.assign(stored.empty() ? 1 : stored[0], nullptr);
    return places.data();
  });
  if (!reading_) return;
  texts.clear();
  for (char* place : places) {
    texts.emplace_back(place == nullptr ? "" : place);
    H5free_memory(place);
  }
}

void Hdf5::data(const std::string& name, std::string& text, const char* unit) {
  std::vector<std::string> one{text};
  texts(name, one, unit, {});
  if (reading_) text = one.front();
}

void Hdf5::data(const std::string& name, std::vector<std::string>& values, const char* unit) {
  texts(name, values, unit, {values.size()});
}

void Hdf5::table(const std::string& name, std::vector<double>& values, std::size_t rows, std::size_t columns,
                 const char* unit) {
  const std::size_t count = rows * columns;
  const bool is_empty = !reading_ && values.empty();
  if (!reading_ && !is_empty && values.size() != count) fail(name + " has another size than its table");
  exchange(name, unit, H5T_NATIVE_DOUBLE, {is_empty ? 0 : rows, columns}, [&](const Extent& extent) {
    const std::size_t stored = extent[0] * extent[1];
    if (reading_ && stored > 0 && (extent[0] != rows || extent[1] != columns))
      fail(name + " has another shape than its table");
    if (reading_) values.resize(stored);
    return values.data();
  });
}

std::string Hdf5::finish() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "the file");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(0, size)), '\0');
  if (size <= 0 || H5Fget_file_image(file_, image.data(), image.size()) != size) fail("no whole HDF5 file");
  return image;
}

}  // namespace launchsafe::store
