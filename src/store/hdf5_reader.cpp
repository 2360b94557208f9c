#include "hdf5_common.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <algorithm>

namespace launchsafe::store {

struct Hdf5Reader::Dataset {
  Hdf5Id id, type;
  std::vector<hsize_t> dimensions;
  std::size_t count = 1;

  bool valid() const { return id.valid(); }
};

Hdf5Reader::Hdf5Reader(std::string_view image) : image_size_(image.size()) {
  silence_hdf5();
  const Hdf5Id access = memory_access();
  // HDF5 copies the image; its signature lacks the const.
  if (access.valid() && !image.empty() &&
      H5Pset_file_image(access.get(), const_cast<char*>(image.data()), image.size()) >= 0) {
    file_ = {H5Fopen(unique_name().c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  }
  if (file_.valid()) groups_.emplace_back(H5Gopen2(file_.get(), "/", H5P_DEFAULT), H5Gclose);
  if (groups_.empty() || !groups_.back().valid()) fail("not a whole HDF5 file: " + hdf5_reason());
}

void Hdf5Reader::fail(const std::string& what) {
  if (!error_) error_ = Error{Error::Kind::corrupt, what};
}

bool Hdf5Reader::enter(const std::string& name) {
  if (failed()) return false;
  Hdf5Id group(H5Gopen2(groups_.back().get(), name.c_str(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
    return false;
  }
  groups_.push_back(std::move(group));
  names_.push_back(name);
  return true;
}

void Hdf5Reader::leave() {
  groups_.pop_back();
  names_.pop_back();
}

bool Hdf5Reader::has(const std::string& name) const {
  return !failed() && H5Lexists(groups_.back().get(), name.c_str(), H5P_DEFAULT) > 0;
}

std::size_t Hdf5Reader::size() const {
  H5G_info_t info{};
  if (failed() || H5Gget_info(groups_.back().get(), &info) < 0) return 0;
  return info.nlinks;
}

void Hdf5Reader::attribute(const std::string& name, std::string& text) {
  if (failed()) return;
  const Hdf5Id attribute(H5Aopen(groups_.back().get(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Id type(attribute.valid() ? H5Aget_type(attribute.get()) : -1, H5Tclose);
  if (!type.valid() || H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Tget_size(type.get()) > image_size_) {
    return fail(path_of(names_, name) + ": no such text attribute");
  }
  text.assign(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0)
    return fail(path_of(names_, name) + ": " + hdf5_reason());
  text.resize(std::min(text.find('\0'), text.size()));
}

Hdf5Reader::Dataset Hdf5Reader::open(const std::string& name, H5T_class_t type_class, std::size_t rank) {
  if (failed()) return {};
  Dataset set;
  set.id = {H5Dopen2(groups_.back().get(), name.c_str(), H5P_DEFAULT), H5Dclose};
  if (set.valid()) set.type = {H5Dget_type(set.id.get()), H5Tclose};
  const Hdf5Id space(set.valid() ? H5Dget_space(set.id.get()) : -1, H5Sclose);
  if (!set.type.valid() || !space.valid()) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
    return {};
  }
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  if (H5Tget_class(set.type.get()) != type_class || dimensions != static_cast<int>(rank)) {
    fail(path_of(names_, name) + " has another type or number of dimensions");
    return {};
  }
  set.dimensions.resize(rank);
  H5Sget_simple_extent_dims(space.get(), set.dimensions.data(), nullptr);
  for (const hsize_t dimension : set.dimensions) {
    if (dimension > image_size_) {
      fail(path_of(names_, name) + " is larger than its file");
      return {};
    }
    set.count *= dimension;
  }
  if (set.count > image_size_ || H5Tget_size(set.type.get()) * set.count > image_size_) {
    fail(path_of(names_, name) + " is larger than its file");
    return {};
  }
  return set;
}

template <class T>
void Hdf5Reader::numbers(const std::string& name, T* single, std::vector<T>* many, const Shape* shape) {
  const std::size_t rank = single != nullptr ? 0 : shape != nullptr ? 2 : 1;
  const Dataset set = open(name, std::same_as<T, double> ? H5T_FLOAT : H5T_INTEGER, rank);
  if (!set.valid()) return;
  if (shape != nullptr && set.count > 0 &&
      (set.dimensions[0] != shape->rows || set.dimensions[1] != shape->columns)) {
    return fail(path_of(names_, name) + " has another shape than the data it belongs to");
  }
  if (many != nullptr) many->assign(set.count, T{});
  T* const data = single != nullptr ? single : many->data();
  if (set.count > 0 && H5Dread(set.id.get(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
  }
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name, std::size_t rank) {
  const Dataset set = open(name, H5T_STRING, rank);
  if (!set.valid()) return {};
  const std::size_t length = H5Tget_size(set.type.get());
  std::string padded(length * set.count, '\0');
  if (H5Tis_variable_str(set.type.get()) != 0 ||
      (set.count > 0 &&
       H5Dread(set.id.get(), set.type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)) {
    fail(path_of(names_, name) + ": " + hdf5_reason());
    return {};
  }
  std::vector<std::string> values;
  for (std::size_t i = 0; i < set.count; ++i) {
    std::string text = padded.substr(i * length, length);
    text.resize(text.find_last_not_of('\0') + 1);
    values.push_back(std::move(text));
  }
  return values;
}

void Hdf5Reader::value(const std::string& name, double& value, const Label&) {
  numbers<double>(name, &value, nullptr, nullptr);
}

void Hdf5Reader::value(const std::string& name, std::int64_t& value, const Label&) {
  numbers<std::int64_t>(name, &value, nullptr, nullptr);
}

void Hdf5Reader::value(const std::string& name, std::uint64_t& value, const Label&) {
  numbers<std::uint64_t>(name, &value, nullptr, nullptr);
}

void Hdf5Reader::value(const std::string& name, std::string& value, const Label&) {
  std::vector<std::string> values = texts(name, 0);
  if (!values.empty()) value = std::move(values.front());
}

void Hdf5Reader::array(const std::string& name, std::vector<double>& values, const Label&) {
  numbers<double>(name, nullptr, &values, nullptr);
}

void Hdf5Reader::array(const std::string& name, std::vector<std::int64_t>& values, const Label&) {
  numbers<std::int64_t>(name, nullptr, &values, nullptr);
}

void Hdf5Reader::array(const std::string& name, std::vector<std::string>& values, const Label&) {
  values = texts(name, 1);
}

void Hdf5Reader::table(const std::string& name, std::vector<double>& values, Shape shape, const Label&) {
  numbers<double>(name, nullptr, &values, &shape);
}

}  // namespace launchsafe::store
