// Trees of values with units in HDF5, written to and read from memory: disk errors never meet the library,
// where a failed close cannot be undone.
#pragma once

#include "launchsafe/store/file.hpp"

#include <hdf5.h>

#include <functional>
#include <type_traits>

namespace launchsafe::store {

/// A file that is written, or read, by the same calls: one description of a layout serves both. `data` stores
/// a value in a file that is written, and fills it from a file that is read. `name` is a path such as
/// "trace/time", whose groups are made; `unit` is an attribute, "1" of pure numbers and "none" of text.
/// Errors name the place: failed (writing), corrupt (reading).
class Hdf5 {
 public:
  /// A new file, to be written.
  Hdf5();
  /// Opens the bytes of a whole file, to be read; they may be freed afterwards.
  explicit Hdf5(std::string_view image);
  ~Hdf5();
  Hdf5(const Hdf5&) = delete;
  Hdf5& operator=(const Hdf5&) = delete;

  bool reading() const { return reading_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// Whether there is a dataset or group of this name.
  bool has(const std::string& name) const;
  /// Number of groups and datasets in a group; 0 without the group.
  std::size_t size(const std::string& group) const;

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void data(const std::string& name, Number& value, const char* unit) {
    exchange(name, unit, type_of<Number>(), {}, [&](const Extent&) { return &value; });
  }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void data(const std::string& name, std::vector<Number>& values, const char* unit) {
    exchange(name, unit, type_of<Number>(), {values.size()}, [&](const Extent& extent) {
      if (reading_) values.resize(extent[0]);
      return values.data();
    });
  }
  void data(const std::string& name, std::string& text, const char* unit);
  void data(const std::string& name, std::vector<std::string>& texts, const char* unit);

  /// Two dimensions, stored row after row. An error when `values` is neither empty nor of this shape.
  void table(const std::string& name, std::vector<double>& values, std::size_t rows, std::size_t columns,
             const char* unit);

  /// The bytes of a file that was written.
  std::string finish();

 private:
  using Extent = std::vector<hsize_t>;  ///< in each dimension; none of a single value

  template <class Number>
  static hid_t type_of() {
    if (std::is_floating_point_v<Number>) return H5T_NATIVE_DOUBLE;
    if (sizeof(Number) < sizeof(std::int64_t)) return sizeof(Number) == 1 ? H5T_NATIVE_UINT8 : H5T_NATIVE_INT;
    return std::is_signed_v<Number> ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64;
  }
  /// Throws where a function of the library failed; otherwise gives its result.
  hid_t check(hid_t result, const std::string& name) const;
  /// Writes or reads a dataset. `place` is called with its extent, the stored one where it is read, and gives
  /// the place of the values in memory.
  void exchange(const std::string& name, const char* unit, hid_t type, Extent extent,
                const std::function<void*(const Extent&)>& place) const;
  void texts(const std::string& name, std::vector<std::string>& texts, const char* unit, Extent extent) const;

  const bool reading_;
  hid_t file_ = -1;  ///< closing it closes all that is open in it
};

}  // namespace launchsafe::store
