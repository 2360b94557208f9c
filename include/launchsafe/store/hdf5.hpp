// Trees of labelled values in HDF5, written to and read from memory: disk errors never meet the library,
// where a failed close cannot be undone. `Hdf5Writer` and `Hdf5Reader` have the same member functions, so
// that one description of a layout serves both. They throw the Error that names the place: failed or corrupt.
#pragma once

#include "launchsafe/store/file.hpp"

#include <hdf5.h>

#include <concepts>

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

/// An open file, and the groups in it that we are in.
class Hdf5File {
 public:
  /// Throws.
  [[noreturn]] void fail(const std::string& what) const { throw Error{kind_, what}; }

 protected:
  explicit Hdf5File(Error::Kind kind);
  hid_t here() const { return groups_.empty() ? file_.get() : groups_.back().get(); }
  /// An identifier of what is called `name` here. Throws where it is none.
  Hdf5Id checked(hid_t id, Hdf5Id::Closer closer, const std::string& name) const;
  /// The same for what a function of the library returns.
  void check(herr_t status, const std::string& name) const;
  /// Runs `body` inside a group.
  template <class Body>
  void inside(Hdf5Id group, Body&& body) {
    groups_.push_back(std::move(group));
    body();
    groups_.pop_back();
  }

  Hdf5Id file_;

 private:
  Error::Kind kind_;
  std::vector<Hdf5Id> groups_;
};

class Hdf5Writer : public Hdf5File {
 public:
  static constexpr bool reading = false;

  Hdf5Writer();

  /// Runs `body` inside a new group.
  template <class Body>
  void group(const std::string& name, const std::string& description, Body&& body) {
    inside(made(name, description), body);
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

  /// The file's bytes.
  std::string finish();

 private:
  Hdf5Id made(const std::string& name, const std::string& description);
  /// A dataset of this extent in each dimension; a single value has none.
  void put(const std::string& name, const Label& label, hid_t type, const std::vector<hsize_t>& extent,
           const void* data);

  Hdf5Id group_creation_, dataset_creation_;
};

class Hdf5Reader : public Hdf5File {
 public:
  static constexpr bool reading = true;

  /// Opens the bytes of a whole HDF5 file; they may be freed afterwards.
  explicit Hdf5Reader(std::string_view image);

  template <class Body>
  void group(const std::string& name, const std::string&, Body&& body) {
    inside(checked(H5Gopen2(here(), name.c_str(), H5P_DEFAULT), H5Gclose, name), body);
  }

  /// Whether the group we are in holds a dataset or group of this name.
  bool has(const std::string& name) const;
  /// Number of groups and datasets in the group we are in.
  std::size_t size() const;

  template <Hdf5Number Number>
  void value(const std::string& name, Number& value, const Label& = {}) {
    read(name, open(name, H5Tget_class(hdf5_type<Number>()), 0), hdf5_type<Number>(), &value);
  }
  void value(const std::string& name, std::string& text, const Label& = {});

  template <Hdf5Number Number>
  void array(const std::string& name, std::vector<Number>& values, const Label& = {}) {
    const Dataset set = open(name, H5Tget_class(hdf5_type<Number>()), 1);
    values.assign(set.count, Number{});
    read(name, set, hdf5_type<Number>(), values.data());
  }
  void array(const std::string& name, std::vector<std::string>& texts, const Label& = {});

  /// An error when the dataset is neither empty nor of this shape.
  void table(const std::string& name, std::vector<double>& values, Shape shape, const Label& = {});

 private:
  struct Dataset {
    Hdf5Id id, type;
    std::vector<hsize_t> extent;
    std::size_t count = 1;
  };

  /// A dataset of the wanted type class with `rank` dimensions.
  Dataset open(const std::string& name, H5T_class_t type_class, std::size_t rank) const;
  void read(const std::string& name, const Dataset& set, hid_t type, void* data) const;
  std::vector<std::string> texts_of(const std::string& name, std::size_t rank) const;
};

}  // namespace launchsafe::store
