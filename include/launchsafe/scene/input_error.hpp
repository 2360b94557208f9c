// What is wrong with an input, as a value: where, what was found, what is allowed, and what was perhaps
// meant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::scene {

/// One fault in something a user wrote. Empty strings and zero lines are parts that do not apply.
struct InputError {
  std::string file;
  int line = 0;               ///< from 1
  int column = 0;             ///< from 1
  std::string key;            ///< dotted, such as "charge.crack_radius"
  std::string found;          ///< what stands there
  std::string allowed;        ///< what may stand there
  std::string suggestion;     ///< what was perhaps meant, ready to be copied
  bool file_missing = false;  ///< there is no such file, so that nothing was found in it

  /// One line of limited length: "scene.toml:12:3: charge.crack_radius: found ...; allowed: ...; did you mean
  /// ...?"
  std::string message() const;
};

/// A fault, if there is one.
using Fault = std::optional<InputError>;

/// A value, or the reason why there is none.
template <class T, class Error = InputError>
class Expected {
 public:
  Expected(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Expected(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// Only where has_value().
  T& value() { return *std::get_if<0>(&content_); }
  const T& value() const { return *std::get_if<0>(&content_); }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// Only where !has_value().
  const Error& error() const { return *std::get_if<1>(&content_); }

  /// The value; throws the error where there is none. For readers, see `caught`.
  T or_throw() && {
    if (!has_value()) throw error();
    return std::move(value());
  }

 private:
  std::variant<T, Error> content_;
};

/// What a reader of many steps gives, or the InputError that it throws: its first fault.
template <class Read>
Expected<std::invoke_result_t<Read>> caught(Read&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    return error;
  }
}
/// Bytes that a message quotes of a part of an InputError. What is allowed may be a list of many keys.
inline constexpr std::size_t longest_quoted = 240, longest_allowed_quoted = 4000, longest_file_quoted = 1000;

/// A text as a message quotes it: on one line, control characters as escapes; of more than `longest` bytes
/// the first.
std::string quotable(std::string_view text, std::size_t longest);

/// The candidate nearest to `word` in letters changed, added, dropped or swapped. Empty if none is near (more
/// than a third of the letters differ, or more than two of them) or several are equally near. Words of
/// hundreds of letters are near to none.
std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b and 3 more": the first ones of several names.
std::string first_of(std::vector<std::string> names, std::size_t most);

/// `"a", "b" or "c"`.
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace launchsafe::scene
