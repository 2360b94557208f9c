#include "hdf5_common.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <algorithm>

namespace launchsafe::store {
namespace {

Hdf5Id space_of(const Hdf5Dataset& set) {
  if (set.rank == 0) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::array<hsize_t, 2> extent{set.extent[0], set.extent[1]};
  return {H5Screate_simple(set.rank, extent.data(), nullptr), H5Sclose};
}

}  // namespace

Hdf5Writer::Hdf5Writer() {
  silence_hdf5();
  group_creation_ = untimed(H5P_GROUP_CREATE);
  dataset_creation_ = untimed(H5P_DATASET_CREATE);
  scalar_ = {H5Screate(H5S_SCALAR), H5Sclose};
  const Hdf5Id access = memory_access();
  if (access.valid())
    file_ = {H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
  if (file_.valid()) groups_.emplace_back(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose);
  if (groups_.empty() || !groups_.back().valid()) fail("cannot begin an HDF5 file: " + hdf5_reason());
}

hid_t Hdf5Writer::text_type_of(std::size_t bytes) {
  Hdf5Id& type = text_types_[bytes];
  if (!type.valid()) type = text_type(bytes);
  return type.get();
}

hid_t Hdf5Writer::type_of(const Hdf5Dataset& set) {
  switch (set.kind) {
    case Hdf5Dataset::Kind::real:
      return memory_type<double>();
    case Hdf5Dataset::Kind::signed_integer:
      return memory_type<std::int64_t>();
    case Hdf5Dataset::Kind::unsigned_integer:
      return memory_type<std::uint64_t>();
    case Hdf5Dataset::Kind::text:
      return text_type_of(set.element_size);
  }
  return H5I_INVALID_HID;
}

bool Hdf5Writer::write_text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const hid_t type = text_type_of(std::max<std::size_t>(1, text.size()));
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), type, scalar_.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  // The library reads one byte of an empty text, which has one: the zero at its end.
  return attribute.valid() && H5Awrite(attribute.get(), type, text.c_str()) >= 0;
}

bool Hdf5Writer::enter(const std::string& name, const std::string& description) {
  Hdf5Id group(
      H5Gcreate2(groups_.back().get(), name.c_str(), H5P_DEFAULT, group_creation_.get(), H5P_DEFAULT),
      H5Gclose);
  if (!group.valid() || !write_text_attribute(group.get(), "description", description)) {
    fail(path_to(name) + ": " + hdf5_reason());
    return false;
  }
  groups_.push_back(std::move(group));
  steps_.push_back(group_step(name, description));
  return true;
}

void Hdf5Writer::leave() {
  groups_.pop_back();
  steps_.push_back(end_step());
}

void Hdf5Writer::put_attribute(const std::string& name, const std::string& text) {
  if (!write_text_attribute(groups_.back().get(), name, text)) {
    return fail(path_to(name) + ": " + hdf5_reason());
  }
  steps_.push_back(attribute_step(name, text));
}

void Hdf5Writer::put_dataset(const Hdf5Dataset& set, const void* data) {
  const hid_t type = type_of(set);
  const Hdf5Id space = space_of(set);
  const Hdf5Id id(H5Dcreate2(groups_.back().get(), set.name.c_str(), type, space.get(), H5P_DEFAULT,
                             dataset_creation_.get(), H5P_DEFAULT),
                  H5Dclose);
  const bool empty = set.bytes() == 0;
  if (!id.valid() || (!empty && H5Dwrite(id.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) ||
      !write_text_attribute(id.get(), "units", set.label.units) ||
      !write_text_attribute(id.get(), "description", set.label.description)) {
    return fail(path_to(set.name) + ": " + hdf5_reason());
  }
  const haddr_t offset = empty ? 0 : H5Dget_offset(id.get());
  if (offset == HADDR_UNDEF) return fail(path_to(set.name) + ": " + hdf5_reason());
  steps_.push_back({set, static_cast<std::size_t>(offset)});
}

Result<std::string> Hdf5Writer::finish(std::size_t room_in_front) {
  if (!failed() && H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0)
    fail("cannot finish the HDF5 file: " + hdf5_reason());
  if (failed()) return *error();
  const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
  const std::size_t bytes = size > 0 ? static_cast<std::size_t>(size) : 0;
  std::string image(room_in_front + bytes, '\0');
  if (size <= 0 || H5Fget_file_image(file_.get(), image.data() + room_in_front, bytes) != size) {
    fail("cannot finish the HDF5 file: " + hdf5_reason());
    return *error();
  }
  return image;
}

}  // namespace launchsafe::store
