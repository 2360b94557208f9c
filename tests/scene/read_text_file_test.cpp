#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace launchsafe::scene {
namespace {

class ReadTextFile : public testing::TemporaryFolder {
 protected:
  std::string found(const std::string& name) const {
    const auto text = read_text_file(folder() / name);
    return text ? "nothing wrong" : text.error().found;
  }
};

TEST_F(ReadTextFile, ReadsRegularFilesOnly) {
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", folder() / "link");
  for (const char* endless : {"pipe", "link", "/dev/zero"}) EXPECT_EQ(found(endless), "a pipe or a device");
  EXPECT_EQ(found(""), "a folder");
  const auto missing = read_text_file(folder() / "none");
  ASSERT_FALSE(missing);
  EXPECT_TRUE(missing.error().file_missing);
  std::ofstream(folder() / "file") << "text";
  std::filesystem::create_symlink("file", folder() / "good_link");
  EXPECT_EQ(*read_text_file(folder() / "good_link"), "text");
  std::filesystem::create_symlink("self", folder() / "self");
  EXPECT_FALSE(read_text_file(folder() / "self"));
}

TEST_F(ReadTextFile, AMissingFileIsSuggestedFromItsFolder) {
  std::ofstream(folder() / "scene.tom") << "text";
  const auto suggestion = [this](const std::string& name) {
    return read_text_file(folder() / name).error().suggestion;
  };
  EXPECT_EQ(suggestion("scene.tml"), '"' + (folder() / "scene.tom").string() + '"');
  EXPECT_EQ(suggestion("quite different"), "");
}

TEST_F(ReadTextFile, AFileHasALargestSize) {
  std::ofstream(folder() / "four") << "text";
  EXPECT_TRUE(read_text_file(folder() / "four", 4));
  EXPECT_FALSE(read_text_file(folder() / "four", 3));
  for (const auto& [name, size] : {std::pair("scene", largest_input), {"curve", largest_curve}}) {
    std::ofstream(folder() / name) << "#";
    std::filesystem::resize_file(folder() / name, size + 1);  // takes no room on the disk
  }
  EXPECT_NE(found("scene").find("16 MiB"), std::string::npos);
  const auto curve = read_pressure_curve(folder() / "curve");
  ASSERT_FALSE(curve);
  EXPECT_NE(curve.error().found.find("64 MiB"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::scene
