#include "hdf5_common.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <algorithm>
#include <cstring>

namespace launchsafe::store {
namespace {

bool write_text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Hdf5Id type = text_type(std::max<std::size_t>(1, text.size()));
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  if (!type.valid() || !space.valid()) return false;
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  return attribute.valid() && H5Awrite(attribute.get(), type.get(), padded.data()) >= 0;
}

}  // namespace

Hdf5Writer::Hdf5Writer() {
  silence_hdf5();
  const Hdf5Id access = memory_access();
  if (access.valid())
    file_ = {H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
  if (file_.valid()) groups_.emplace_back(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose);
  if (groups_.empty() || !groups_.back().valid()) fail("cannot begin an HDF5 file: " + hdf5_reason());
}

void Hdf5Writer::fail(const std::string& what) {
  if (!error_) error_ = Error{Error::Kind::failed, what};
}

bool Hdf5Writer::enter(const std::string& name, const std::string& description) {
  if (failed()) return false;
  const Hdf5Id creation = untimed(H5P_GROUP_CREATE);
  Hdf5Id group(H5Gcreate2(groups_.back().get(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
               H5Gclose);
  if (!group.valid() || !write_text_attribute(group.get(), "description", description)) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
    return false;
  }
  groups_.push_back(std::move(group));
  names_.push_back(name);
  return true;
}

void Hdf5Writer::leave() {
  groups_.pop_back();
  names_.pop_back();
}

void Hdf5Writer::attribute(const std::string& name, const std::string& text) {
  if (!failed() && !write_text_attribute(groups_.back().get(), name, text)) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
  }
}

void Hdf5Writer::dataset(const std::string& name, hid_t type, const std::vector<hsize_t>& dimensions,
                         const void* data, const Label& label) {
  if (failed()) return;
  if (label.units.empty() || label.description.empty())
    return fail(path_of(names_, name) + " lacks its units");
  const Hdf5Id space(dimensions.empty()
                         ? H5Screate(H5S_SCALAR)
                         : H5Screate_simple(static_cast<int>(dimensions.size()), dimensions.data(), nullptr),
                     H5Sclose);
  const Hdf5Id creation = untimed(H5P_DATASET_CREATE);
  const Hdf5Id set(H5Dcreate2(groups_.back().get(), name.c_str(), type, space.get(), H5P_DEFAULT,
                              creation.get(), H5P_DEFAULT),
                   H5Dclose);
  const bool empty = std::find(dimensions.begin(), dimensions.end(), hsize_t{0}) != dimensions.end();
  if (!set.valid() || (!empty && H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) ||
      !write_text_attribute(set.get(), "units", label.units) ||
      !write_text_attribute(set.get(), "description", label.description)) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
  }
}

void Hdf5Writer::value(const std::string& name, double value, const Label& label) {
  dataset(name, memory_type<double>(), {}, &value, label);
}

void Hdf5Writer::value(const std::string& name, std::int64_t value, const Label& label) {
  dataset(name, memory_type<std::int64_t>(), {}, &value, label);
}

void Hdf5Writer::value(const std::string& name, std::uint64_t value, const Label& label) {
  dataset(name, memory_type<std::uint64_t>(), {}, &value, label);
}

void Hdf5Writer::value(const std::string& name, const std::string& value, const Label& label) {
  const Hdf5Id type = text_type(std::max<std::size_t>(1, value.size()));
  const std::string padded = value.empty() ? std::string(1, '\0') : value;
  dataset(name, type.get(), {}, padded.data(), label);
}

void Hdf5Writer::array(const std::string& name, const std::vector<double>& values, const Label& label) {
  dataset(name, memory_type<double>(), {values.size()}, values.data(), label);
}

void Hdf5Writer::array(const std::string& name, const std::vector<std::int64_t>& values, const Label& label) {
  dataset(name, memory_type<std::int64_t>(), {values.size()}, values.data(), label);
}

void Hdf5Writer::array(const std::string& name, const std::vector<std::string>& values, const Label& label) {
  std::size_t longest = 1;
  for (const std::string& text : values) longest = std::max(longest, text.size());
  std::string padded(longest * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(padded.data() + i * longest, longest);
  dataset(name, text_type(longest).get(), {values.size()}, padded.data(), label);
}

void Hdf5Writer::table(const std::string& name, const std::vector<double>& values, Shape shape,
                       const Label& label) {
  if (!values.empty() && values.size() != shape.rows * shape.columns) {
    return fail(path_of(names_, name) + " has " + std::to_string(values.size()) + " values, not " +
                std::to_string(shape.rows) + " x " + std::to_string(shape.columns));
  }
  dataset(name, memory_type<double>(), {values.empty() ? 0 : shape.rows, shape.columns}, values.data(),
          label);
}

Result<std::string> Hdf5Writer::finish() {
  if (!failed() && H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0)
    fail("cannot finish the HDF5 file: " + hdf5_reason());
  if (failed()) return *error_;
  const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(file_.get(), image.data(), image.size()) != size) {
    fail("cannot finish the HDF5 file: " + hdf5_reason());
    return *error_;
  }
  return image;
}

}  // namespace launchsafe::store
