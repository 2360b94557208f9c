#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
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
  const int number = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder() / "socket").c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(number);
  std::filesystem::create_symlink("pipe", folder() / "link");
  EXPECT_EQ(found("pipe"), "a pipe");
  EXPECT_EQ(found("link"), "a pipe");
  EXPECT_EQ(found("socket"), "a socket");
  EXPECT_EQ(found(""), "a folder");
  EXPECT_EQ(found("/dev/zero"), "a device");
  EXPECT_EQ(found("/dev/full"), "a device");
  const auto missing = read_text_file(folder() / "none");
  ASSERT_FALSE(missing);
  EXPECT_TRUE(missing.error().file_missing);
  std::ofstream(folder() / "file") << "text";
  std::filesystem::create_symlink("file", folder() / "good_link");
  EXPECT_EQ(*read_text_file(folder() / "good_link"), "text");
  std::filesystem::create_symlink("self", folder() / "self");
  EXPECT_NE(found("self").find("cannot be read"), std::string::npos);
}

TEST_F(ReadTextFile, AMissingFileIsSuggestedFromTheFoldersBesideIt) {
  std::filesystem::create_directories(folder() / "studies/scene.toml.d");
  std::ofstream(folder() / "studies/scene.toml") << "text";
  std::ofstream(folder() / "scene.tom") << "text";
  const auto suggestion = [this](const std::string& name) {
    return read_text_file(folder() / name).error().suggestion;
  };
  EXPECT_EQ(suggestion("scene.toml"), '"' + (folder() / "studies/scene.toml").string() + '"');
  EXPECT_EQ(suggestion("scene.tml"), '"' + (folder() / "scene.tom").string() + '"');
  EXPECT_EQ(suggestion("quite different"), "");
}

TEST_F(ReadTextFile, InThePlaceOfAFolderTheFilesOfThatContentInItAreSuggested) {
  std::ofstream(folder() / "a.toml") << "kind = \"critical-gap\"";
  std::ofstream(folder() / "b.toml") << "kind = \"accuracy\"";
  std::ofstream(folder() / "scene.toml") << "body = []";
  std::ofstream(folder() / "notes.md") << "kind = \"accuracy\"";
  const auto suggestion = [this](InputContent wanted) {
    return read_text_file(folder(), largest_input, wanted).error().suggestion;
  };
  const std::string studies = quoted_list({(folder() / "a.toml").string(), (folder() / "b.toml").string()});
  EXPECT_EQ(suggestion(InputContent::study), studies);
  EXPECT_EQ(suggestion(InputContent::scene), quoted_list({(folder() / "scene.toml").string()}));
  EXPECT_EQ(suggestion(InputContent::unknown), "");
}

TEST_F(ReadTextFile, AFileHasALargestSize) {
  std::ofstream(folder() / "four") << "text";
  EXPECT_TRUE(read_text_file(folder() / "four", 4));
  EXPECT_FALSE(read_text_file(folder() / "four", 3));
  for (const auto& [name, size] : {std::pair("scene", largest_input), {"curve", largest_curve}}) {
    std::ofstream(folder() / name) << "#";
    std::filesystem::resize_file(folder() / name, size + 1);  // takes no room on the disk
  }
  EXPECT_EQ(found("scene"), "a file of more than 16 MiB");
  const auto curve = read_pressure_curve(folder() / "curve");
  ASSERT_FALSE(curve);
  EXPECT_EQ(curve.error().found, "a file of more than 64 MiB");
}

}  // namespace
}  // namespace launchsafe::scene
