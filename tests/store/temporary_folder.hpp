// An empty folder of a test's own, gone afterwards.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::testing {

/// Makes an empty folder, which is the caller's to remove. Its path is empty where none can be made.
inline std::filesystem::path new_temporary_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "launchsafe-XXXXXX").string();
  return ::mkdtemp(name.data()) == nullptr ? std::filesystem::path() : std::filesystem::path(name);
}

/// An empty folder for several tests, gone with this object.
struct SharedFolder {
  const std::filesystem::path path = new_temporary_folder();

  SharedFolder() = default;
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;
  ~SharedFolder() { std::filesystem::remove_all(path); }
};

class TemporaryFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = new_temporary_folder();
    ASSERT_FALSE(folder_.empty());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path& folder() const { return folder_; }

  /// The names of all that is in the folder.
  std::vector<std::string> listing() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      names.push_back(entry.path().filename());
    return names;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace launchsafe::testing
