#include "launchsafe/store/hdf5.hpp"

#include <algorithm>

namespace launchsafe::store {
namespace {

/// Texts of their own take multiples of this: it is part of the format of case files.
constexpr std::size_t text_step = 256;

/// HDF5 prints its errors on stderr unless told otherwise, in every thread anew.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// An access list whose files live in memory alone.
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

/// A name for a file in memory. HDF5 takes two open ones of the same name for the same file.
std::string unique_name() {
  static std::atomic<std::uint64_t> count{0};
  return "memory " + std::to_string(count++);
}

/// A creation list (of H5P_DATASET_CREATE or H5P_GROUP_CREATE) without time stamps: the same content gives
/// the same bytes.
Hdf5Id untimed(hid_t list_class) {
  Hdf5Id creation(H5Pcreate(list_class), H5Pclose);
  if (!creation.valid() || H5Pset_obj_track_times(creation.get(), false) < 0) return {};
  return creation;
}

/// A fixed-length text type (UTF-8, padded with zeros).
Hdf5Id text_type(std::size_t bytes) {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (!type.valid() || H5Tset_size(type.get(), bytes) < 0 || H5Tset_cset(type.get(), H5T_CSET_UTF8) < 0 ||
      H5Tset_strpad(type.get(), H5T_STR_NULLPAD) < 0) {
    return {};
  }
  return type;
}

herr_t write_text_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Hdf5Id type = text_type(std::max<std::size_t>(1, text.size()));
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  // The library reads one byte of an empty text, which has one: the zero at its end.
  return attribute.valid() ? H5Awrite(attribute.get(), type.get(), text.c_str()) : -1;
}

}  // namespace

// --- both ---

Hdf5File::Hdf5File(Error::Kind kind) : kind_(kind) { silence_hdf5(); }

void Hdf5File::check(herr_t status, const std::string& name) const {
  if (status < 0) fail(name + " cannot be read or written as HDF5");
}

Hdf5Id Hdf5File::checked(hid_t id, Hdf5Id::Closer closer, const std::string& name) const {
  check(id < 0 ? -1 : 0, name);
  return {id, closer};
}

// --- writing ---

Hdf5Writer::Hdf5Writer()
    : Hdf5File(Error::Kind::failed),
      group_creation_(untimed(H5P_GROUP_CREATE)),
      dataset_creation_(untimed(H5P_DATASET_CREATE)) {
  if (const Hdf5Id access = memory_access(); access.valid())
    file_ = {H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
  if (!file_.valid()) fail("cannot begin an HDF5 file");
}

Hdf5Id Hdf5Writer::made(const std::string& name, const std::string& description) {
  Hdf5Id group = checked(H5Gcreate2(here(), name.c_str(), H5P_DEFAULT, group_creation_.get(), H5P_DEFAULT),
                         H5Gclose, name);
  check(write_text_attribute(group.get(), "description", description), name);
  return group;
}

void Hdf5Writer::attribute(const std::string& name, const std::string& text) {
  check(write_text_attribute(here(), name, text), name);
}

void Hdf5Writer::put(const std::string& name, const Label& label, hid_t type,
                     const std::vector<hsize_t>& extent, const void* data) {
  if (label.units.empty() || label.description.empty()) fail(name + " lacks its units");
  const Hdf5Id space(extent.empty()
                         ? H5Screate(H5S_SCALAR)
                         : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                     H5Sclose);
  const Hdf5Id set = checked(
      H5Dcreate2(here(), name.c_str(), type, space.get(), H5P_DEFAULT, dataset_creation_.get(), H5P_DEFAULT),
      H5Dclose, name);
  const bool empty = std::ranges::find(extent, hsize_t{0}) != extent.end();
  if (!empty) check(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
  check(write_text_attribute(set.get(), "units", label.units), name);
  check(write_text_attribute(set.get(), "description", label.description), name);
}

void Hdf5Writer::value(const std::string& name, const std::string& text, const Label& label) {
  std::string padded = text;
  padded.resize(std::max<std::size_t>(1, (text.size() + text_step - 1) / text_step) * text_step, '\0');
  put(name, label, text_type(padded.size()).get(), {}, padded.data());
}

void Hdf5Writer::array(const std::string& name, const std::vector<std::string>& texts, const Label& label) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string padded(longest * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(padded.data() + i * longest, longest);
  put(name, label, text_type(longest).get(), {texts.size()}, padded.data());
}

void Hdf5Writer::table(const std::string& name, const std::vector<double>& values, Shape shape,
                       const Label& label) {
  if (!values.empty() && values.size() != shape.rows * shape.columns)
    fail(name + " has another number of values than its shape");
  put(name, label, hdf5_type<double>(), {values.empty() ? 0 : shape.rows, shape.columns}, values.data());
}

std::string Hdf5Writer::finish() {
  const bool flushed = H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(file_.get(), nullptr, 0) : 0;
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(0, size)), '\0');
  if (size <= 0 || H5Fget_file_image(file_.get(), image.data(), image.size()) != size)
    fail("cannot finish the HDF5 file");
  return image;
}

// --- reading ---

Hdf5Reader::Hdf5Reader(std::string_view image) : Hdf5File(Error::Kind::corrupt) {
  const Hdf5Id access = memory_access();
  // HDF5 copies the image; its signature lacks the const.
  if (access.valid() && !image.empty() &&
      H5Pset_file_image(access.get(), const_cast<char*>(image.data()), image.size()) >= 0)
    file_ = {H5Fopen(unique_name().c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  if (!file_.valid()) fail("not a whole HDF5 file");
}

bool Hdf5Reader::has(const std::string& name) const {
  return H5Lexists(here(), name.c_str(), H5P_DEFAULT) > 0;
}

std::size_t Hdf5Reader::size() const {
  H5G_info_t info{};
  return H5Gget_info(here(), &info) < 0 ? 0 : info.nlinks;
}

Hdf5Reader::Dataset Hdf5Reader::open(const std::string& name, H5T_class_t type_class,
                                     std::size_t rank) const {
  Dataset set;
  set.id = checked(H5Dopen2(here(), name.c_str(), H5P_DEFAULT), H5Dclose, name);
  set.type = checked(H5Dget_type(set.id.get()), H5Tclose, name);
  const Hdf5Id space = checked(H5Dget_space(set.id.get()), H5Sclose, name);
  if (H5Tget_class(set.type.get()) != type_class ||
      H5Sget_simple_extent_ndims(space.get()) != static_cast<int>(rank))
    fail(name + " has another type or number of dimensions");
  set.extent.resize(rank);
  H5Sget_simple_extent_dims(space.get(), set.extent.data(), nullptr);
  for (const hsize_t length : set.extent) set.count *= length;
  return set;
}

void Hdf5Reader::read(const std::string& name, const Dataset& set, hid_t type, void* data) const {
  if (set.count > 0) check(H5Dread(set.id.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

std::vector<std::string> Hdf5Reader::texts_of(const std::string& name, std::size_t rank) const {
  const Dataset set = open(name, H5T_STRING, rank);
  const std::size_t length = H5Tget_size(set.type.get());
  std::string padded(length * set.count, '\0');
  read(name, set, set.type.get(), padded.data());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < set.count; ++i) {
    std::string text = padded.substr(i * length, length);
    text.resize(text.find_last_not_of('\0') + 1);
    texts.push_back(std::move(text));
  }
  return texts;
}

void Hdf5Reader::value(const std::string& name, std::string& text, const Label&) {
  text = texts_of(name, 0).front();
}

void Hdf5Reader::array(const std::string& name, std::vector<std::string>& texts, const Label&) {
  texts = texts_of(name, 1);
}

void Hdf5Reader::table(const std::string& name, std::vector<double>& values, Shape shape, const Label&) {
  const Dataset set = open(name, H5T_FLOAT, 2);
  if (set.count > 0 && (set.extent[0] != shape.rows || set.extent[1] != shape.columns))
    fail(name + " has another shape than the data it belongs to");
  values.assign(set.count, 0.0);
  read(name, set, hdf5_type<double>(), values.data());
}

}  // namespace launchsafe::store
