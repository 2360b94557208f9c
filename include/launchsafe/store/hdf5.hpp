// Trees of labelled values in HDF5, written to and read from memory: disk errors never meet the library,
// whose failed closes cannot be undone. `Hdf5Output` and `Hdf5Reader` have the same member functions, so that
// one description of a layout serves both. The first error sticks; what follows it does nothing.
#pragma once

#include "launchsafe/store/result.hpp"

#include <hdf5.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace launchsafe::store {

/// What a dataset holds. Both become its attributes; units is "1" for pure numbers and "none" for text.
struct Label {
  std::string units;
  std::string description;
  bool operator==(const Label&) const = default;
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

/// Rows of a dataset with two dimensions, stored row after row.
struct Shape {
  std::size_t rows = 0, columns = 0;
};

/// A dataset on its way into a file: `extent[0]` to `extent[rank - 1]` elements of `element_size` bytes.
struct Hdf5Dataset {
  enum class Kind { real, signed_integer, unsigned_integer, text };

  std::string name;
  Label label;
  Kind kind = Kind::real;
  std::size_t element_size = 0;
  int rank = 0;
  std::array<std::size_t, 2> extent{1, 1};

  std::size_t bytes() const { return element_size * extent[0] * extent[1]; }
  bool operator==(const Hdf5Dataset&) const = default;
};

/// Takes a tree; what becomes of it is the heirs' business.
class Hdf5Output {
 public:
  static constexpr bool reading = false;

  Hdf5Output() = default;
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;
  virtual ~Hdf5Output() = default;

  /// Runs `body` inside a new group.
  template <class Body>
  void group(const std::string& name, const std::string& description, Body&& body) {
    if (failed() || !enter(name, description)) return;
    names_.push_back(name);
    body();
    names_.pop_back();
    leave();
  }

  /// A text attribute of the group we are in.
  void attribute(const std::string& name, const std::string& text);

  void value(const std::string& name, double value, const Label& label);
  void value(const std::string& name, std::int64_t value, const Label& label);
  void value(const std::string& name, std::uint64_t value, const Label& label);
  void value(const std::string& name, const std::string& value, const Label& label);

  void array(const std::string& name, const std::vector<double>& values, const Label& label);
  void array(const std::string& name, const std::vector<std::int64_t>& values, const Label& label);
  void array(const std::string& name, const std::vector<std::string>& values, const Label& label);

  /// Two dimensions. An error when `values` is neither empty nor of the size that the shape says.
  void table(const std::string& name, const std::vector<double>& values, Shape shape, const Label& label);

  /// Ends the writing with an error of the caller's own.
  void fail(const std::string& what);
  bool failed() const { return error_.has_value(); }
  /// The first error, of kind failed.
  const MaybeError& error() const { return error_; }

 protected:
  /// The names of the groups we are in, and a last one: "/trace/stations".
  std::string path_to(const std::string& name) const;

 private:
  virtual bool enter(const std::string& name, const std::string& description) = 0;
  virtual void leave() = 0;
  virtual void put_attribute(const std::string& name, const std::string& text) = 0;
  virtual void put_dataset(const Hdf5Dataset& set, const void* data) = 0;

  void put(const Hdf5Dataset& set, const void* data);

  std::vector<std::string> names_;
  MaybeError error_;
};

/// Something that an `Hdf5Output` was told, and where its data begin in the file.
struct Hdf5Step {
  Hdf5Dataset set;         ///< for a group or an attribute only the name and, as description, the text
  std::size_t offset = 0;  ///< bytes, of what has data
};

/// Writes by the HDF5 library.
class Hdf5Writer : public Hdf5Output {
 public:
  Hdf5Writer();

  /// The file's bytes after `room_in_front` zeros for the caller's use. Errors: failed, also when any call
  /// before failed.
  Result<std::string> finish(std::size_t room_in_front = 0);

  /// All that was written, in order; the offsets count from the beginning of the HDF5 file.
  const std::vector<Hdf5Step>& steps() const { return steps_; }

 private:
  bool enter(const std::string& name, const std::string& description) override;
  void leave() override;
  void put_attribute(const std::string& name, const std::string& text) override;
  void put_dataset(const Hdf5Dataset& set, const void* data) override;

  bool write_text_attribute(hid_t object, const std::string& name, const std::string& text);
  hid_t type_of(const Hdf5Dataset& set);
  hid_t text_type_of(std::size_t bytes);

  // What many objects of a file have in common is made once: that is a good part of the library's time.
  Hdf5Id group_creation_, dataset_creation_, scalar_;
  std::map<std::size_t, Hdf5Id> text_types_;
  Hdf5Id file_;
  std::vector<Hdf5Id> groups_;
  std::vector<Hdf5Step> steps_;
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
    leave();
  }

  /// Whether the group we are in holds a dataset or group of this name.
  bool has(const std::string& name) const;
  /// Number of groups and datasets in the group we are in.
  std::size_t size() const;

  void attribute(const std::string& name, std::string& text);

  void value(const std::string& name, double& value, const Label& label = {});
  void value(const std::string& name, std::int64_t& value, const Label& label = {});
  void value(const std::string& name, std::uint64_t& value, const Label& label = {});
  void value(const std::string& name, std::string& value, const Label& label = {});

  void array(const std::string& name, std::vector<double>& values, const Label& label = {});
  void array(const std::string& name, std::vector<std::int64_t>& values, const Label& label = {});
  void array(const std::string& name, std::vector<std::string>& values, const Label& label = {});

  /// An error when the dataset is neither empty nor of this shape.
  void table(const std::string& name, std::vector<double>& values, Shape shape, const Label& label = {});

  void fail(const std::string& what);
  bool failed() const { return error_.has_value(); }

  /// The first error, of kind corrupt.
  const MaybeError& error() const { return error_; }

 private:
  struct Dataset;

  bool enter(const std::string& name);
  void leave();
  /// An open dataset of the wanted type class with `rank` dimensions, or an invalid one after an error.
  Dataset open(const std::string& name, H5T_class_t type_class, std::size_t rank);
  template <class T>
  void numbers(const std::string& name, T* single, std::vector<T>* many, const Shape* shape);
  std::vector<std::string> texts(const std::string& name, std::size_t rank);

  std::size_t image_size_ = 0;
  Hdf5Id file_;
  std::vector<Hdf5Id> groups_;
  std::vector<std::string> names_;
  MaybeError error_;
};

}  // namespace launchsafe::store
