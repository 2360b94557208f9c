#include "hdf5_common.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <algorithm>

namespace launchsafe::store {
namespace {

using Kind = Hdf5Dataset::Kind;

/// Texts of their own take multiples of this, so that files that differ in a few letters have one shape.
constexpr std::size_t text_step = 256;

}  // namespace

void Hdf5Output::fail(const std::string& what) {
  if (!error_) error_ = Error{Error::Kind::failed, what};
}

std::string Hdf5Output::path_to(const std::string& name) const { return path_of(names_, name); }

void Hdf5Output::put(const Hdf5Dataset& set, const void* data) {
  if (failed()) return;
  if (set.label.units.empty() || set.label.description.empty())
    return fail(path_to(set.name) + " lacks its units");
  put_dataset(set, data);
}

void Hdf5Output::attribute(const std::string& name, const std::string& text) {
  if (!failed()) put_attribute(name, text);
}

void Hdf5Output::value(const std::string& name, double value, const Label& label) {
  put({name, label, Kind::real, sizeof value}, &value);
}

void Hdf5Output::value(const std::string& name, std::int64_t value, const Label& label) {
  put({name, label, Kind::signed_integer, sizeof value}, &value);
}

void Hdf5Output::value(const std::string& name, std::uint64_t value, const Label& label) {
  put({name, label, Kind::unsigned_integer, sizeof value}, &value);
}

void Hdf5Output::value(const std::string& name, const std::string& value, const Label& label) {
  const std::size_t size = std::max<std::size_t>(1, (value.size() + text_step - 1) / text_step) * text_step;
  std::string padded = value;
  padded.resize(size, '\0');
  put({name, label, Kind::text, size}, padded.data());
}

void Hdf5Output::array(const std::string& name, const std::vector<double>& values, const Label& label) {
  put({name, label, Kind::real, sizeof(double), 1, {values.size(), 1}}, values.data());
}

void Hdf5Output::array(const std::string& name, const std::vector<std::int64_t>& values, const Label& label) {
  put({name, label, Kind::signed_integer, sizeof(std::int64_t), 1, {values.size(), 1}}, values.data());
}

void Hdf5Output::array(const std::string& name, const std::vector<std::string>& values, const Label& label) {
  std::size_t longest = 1;
  for (const std::string& text : values) longest = std::max(longest, text.size());
  std::string padded(longest * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(padded.data() + i * longest, longest);
  put({name, label, Kind::text, longest, 1, {values.size(), 1}}, padded.data());
}

void Hdf5Output::table(const std::string& name, const std::vector<double>& values, Shape shape,
                       const Label& label) {
  if (!values.empty() && values.size() != shape.rows * shape.columns) {
    return fail(path_to(name) + " has " + std::to_string(values.size()) + " values, not " +
                std::to_string(shape.rows) + " x " + std::to_string(shape.columns));
  }
  put({name, label, Kind::real, sizeof(double), 2, {values.empty() ? 0 : shape.rows, shape.columns}},
      values.data());
}

}  // namespace launchsafe::store
