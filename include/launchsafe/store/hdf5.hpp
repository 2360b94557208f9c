// Trees of labelled values in HDF5, written to and read from memory: disk errors never meet the library,
// whose failed closes cannot be undone. `Hdf5Writer` and `Hdf5Reader` have the same member functions, so that
// one description of a layout serves both. The first error sticks; what follows it does nothing.
#pragma once

#include "launchsafe/store/result.hpp"

#include <hdf5.h>

#include <concepts>
#include <cstdint>

namespace launchsafe::store {

/// What a dataset holds. Both become its attributes; units is "1" for pure numbers and "none" for text.
struct Label {
  std::string units;
  std::string description;
};

/// Rows of a dataset with two dimensions, stored row after row.
struct Shape {
  std::size_t rows = 0, columns = 0;
};

/// An HDF5 identifier, closed at the end of its scope.
class Hdf5Id {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Id() = default;
  Hdf5Id(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Hdf5Id() {
    if (id_ >= 0) closer_(id_);
  }

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

template <class T>
concept Hdf5Number =
    std::same_as<T, double> || std::same_as<T, std::int64_t> || std::same_as<T, std::uint64_t>;

/// The library's type of a number in memory.
template <Hdf5Number Number>
hid_t hdf5_type() {
  if constexpr (std::same_as<Number, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<Number, std::int64_t>) return H5T_NATIVE_INT64;
  return H5T_NATIVE_UINT64;
}

class Hdf5Writer {
 public:
  static constexpr bool reading = false;

  Hdf5Writer();

  /// Runs `body` inside a new group.
  template <class Body>
  void group(const std::string& name, const std::string& description, Body&& body) {
    if (!enter(name, description)) return;
    body();
    groups_.pop_back();
  }

  /// A text attribute of the group we are in.
  void attribute(const std::string& name, const std::string& text);

  template <Hdf5Number Number>
  void value(const std::string& name, Number value, const Label& label) {
    put(name, label, hdf5_type<Number>(), {}, &value);
  }
  void value(const std::string& name, const std::string& text, const Label& label);

  template <Hdf5Number Number>
  void array(const std::string& name, const std::vector<Number>& values, const Label& label) {
    put(name, label, hdf5_type<Number>(), {values.size()}, values.data());
  }
  void array(const std::string& name, const std::vector<std::string>& texts, const Label& label);

  /// Two dimensions. An error when `values` is neither empty nor of the size that the shape says.
  void table(const std::string& name, const std::vector<double>& values, Shape shape, const Label& label);

  void fail(const std::string& what);
  bool failed() const { return error_.has_value(); }

  /// The file's bytes. Errors: failed, also when any call before failed.
  Result<std::string> finish();

 private:
  hid_t here() const { return groups_.empty() ? file_.get() : groups_.back().get(); }
  bool enter(const std::string& name, const std::string& description);
  /// A dataset of this extent in each dimension; a single value has none.
  void put(const std::string& name, const Label& label, hid_t type, const std::vector<hsize_t>& extent,
           const void* data);

  Hdf5Id group_creation_, dataset_creation_, file_;
  std::vector<Hdf5Id> groups_;
  MaybeError error_;
};

class Hdf5Reader {
 public:
  static constexpr bool reading = true;

  /// Opens the bytes of a whole HDF5 file; they may be freed afterwards.
  explicit Hdf5Reader(std::string_view image);

  template <class Body>
  void group(const std::string& name, const std::string&, Body&& body) {
    if (!enter(name)) return;
    body();
    groups_.pop_back();
  }

  /// Whether the group we are in holds a dataset or group of this name.
  bool has(const std::string& name) const;
  /// Number of groups and datasets in the group we are in.
  std::size_t size() const;

  void attribute(const std::string& name, std::string& text);

  template <Hdf5Number Number>
  void value(const std::string& name, Number& value, const Label& = {}) {
    if (const Dataset set = open(name, H5Tget_class(hdf5_type<Number>()), 0); set.id.valid())
      read(name, set, hdf5_type<Number>(), &value);
  }
  void value(const std::string& name, std::string& text, const Label& = {});

  template <Hdf5Number Number>
  void array(const std::string& name, std::vector<Number>& values, const Label& = {}) {
    const Dataset set = open(name, H5Tget_class(hdf5_type<Number>()), 1);
    if (!set.id.valid()) return;
    values.assign(set.count, Number{});
    read(name, set, hdf5_type<Number>(), values.data());
  }
  void array(const std::string& name, std::vector<std::string>& texts, const Label& = {});

  /// An error when the dataset is neither empty nor of this shape.
  void table(const std::string& name, std::vector<double>& values, Shape shape, const Label& = {});

  void fail(const std::string& what);
  bool failed() const { return error_.has_value(); }

  /// The first error, of kind corrupt.
  const MaybeError& error() const { return error_; }

 private:
  struct Dataset {
    Hdf5Id id, type;
    std::vector<hsize_t> extent;
    std::size_t count = 1;
  };

  hid_t here() const { return groups_.empty() ? file_.get() : groups_.back().get(); }
  bool enter(const std::string& name);
  /// An open dataset of the wanted type class with `rank` dimensions; without an id after an error.
  Dataset open(const std::string& name, H5T_class_t type_class, std::size_t rank);
  void read(const std::string& name, const Dataset& set, hid_t type, void* data);
  std::vector<std::string> texts_of(const std::string& name, std::size_t rank);

  std::size_t image_size_ = 0;
  Hdf5Id file_;
  std::vector<Hdf5Id> groups_;
  MaybeError error_;
};

}  // namespace launchsafe::store
