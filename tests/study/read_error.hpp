// What a study file that is wrong must say.
#pragma once

#include "study/synthetic_launch.hpp"

#include <string>

namespace launchsafe::study {

/// Parts that the message of an InputError must have.
struct ExpectedError {
  int line = 0;
  std::string key;
  std::string found;
  std::string allowed = "";
  std::string suggestion = "";
};

inline scene::InputError error_in(const std::string& text) {
  const auto study = parse_here(text);
  EXPECT_FALSE(study) << "the study was accepted:\n" << text;
  return study ? scene::InputError{} : study.error();
}

inline void expect_error_in(const std::string& text, const ExpectedError& expected) {
  const scene::InputError error = error_in(text);
  const std::string message = error.message() + "\nin\n" + text;
  EXPECT_NE(error.file.find("some_study.toml"), std::string::npos) << message;
  EXPECT_EQ(error.line, expected.line) << message;
  EXPECT_EQ(error.key, expected.key) << message;
  EXPECT_NE(error.found.find(expected.found), std::string::npos) << message;
  EXPECT_NE(error.allowed.find(expected.allowed), std::string::npos) << message;
  EXPECT_FALSE(error.allowed.empty()) << message;
  EXPECT_NE(error.suggestion.find(expected.suggestion), std::string::npos) << message;
}

}  // namespace launchsafe::study
