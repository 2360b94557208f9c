// What is wrong with an input: the one exception that readers throw, and the words in it.
#pragma once

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

  /// "scene.toml:12:3: charge.crack_radius: found ...; allowed: ...; did you mean ...?" on one line.
  std::string message() const;
};

/// A value, or the reason why there is none.
template <class T, class Error = InputError>
class Expected {
 public:
  Expected(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Expected(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  /// The value, where there is one.
  T& operator*() { return *std::get_if<0>(&content_); }
  const T& operator*() const { return *std::get_if<0>(&content_); }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }
  /// The reason, where there is no value.
  const Error& error() const { return *std::get_if<1>(&content_); }
  /// The value; throws the error where there is none.
  T or_throw() && {
    if (!*this) throw error();
    return std::move(**this);
  }

 private:
  std::variant<T, Error> content_;
};

/// What a reader gives, or the InputError that it throws.
template <class Read>
Expected<std::invoke_result_t<Read>> caught(Read&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    return error;
  }
}

/// A text as a message quotes it: on one line, with control characters as escapes; of a long one the first
/// bytes, at most `longest`.
std::string quotable(std::string_view text, std::size_t longest);

/// The candidate nearest to `word` in letters changed, added, dropped or swapped. Empty if none is near (more
/// than a third of the letters differ, or more than two of them) or several are equally near.
std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b and 3 more": the first ones of several names.
std::string first_of(std::vector<std::string> names, std::size_t most);

/// `"a", "b" or "c"`.
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace launchsafe::scene
