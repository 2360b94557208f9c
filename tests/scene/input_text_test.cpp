// Text that readers meet: files, other encodings, what would exhaust them; and messages about it.
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace launchsafe::scene {
namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

/// After a line that is right: deep nesting needs more stack than there is; toml++ asserts that a key or a
/// value begins as one may, and calls letters beyond ASCII outside of a text unreachable (toml_reader.cpp).
TEST(InputText, WhatIsNoTomlIsAnErrorWithItsLine) {
  constexpr std::size_t deep = 100'000;
  for (const std::string& text :
       {"a = " + repeated("[", deep), "a = " + repeated("[", deep) + repeated("]", deep), repeated("[", deep),
        "a = " + repeated("{ a = ", deep) + "1" + repeated(" }", deep), "a = " + repeated("[ { a = ", deep),
        std::string("# \u20ac \xE4\n"), std::string("# \xED\xA0\x80\n"), std::string(1, '\0'),
        std::string("[;]"), std::string("[[;;input]]\nkey = 1"), std::string("[[[a]]]"),
        std::string("[\x01]"), std::string("a = [ } ]"), std::string("a = { b = }"), std::string("a ="),
        std::string("\u00e9 = 1"), std::string("d = 1979-05-27T0\u00e9"), std::string("a = 1 \u00b5")}) {
    const auto table = caught([&] { return parse_toml("x = 1\n" + text, "shell.toml"); });
    ASSERT_FALSE(table) << text.substr(0, 100);
    EXPECT_EQ(table.error().line, 2) << table.error().message();
  }
  const toml::table table =
      parse_toml("\xEF\xBB\xBF'\u00b5' = 1\nb = \"caf\u00e9 \U0001F680\"", "shell.toml");
  EXPECT_EQ(table["b"].value<std::string>(), "caf\u00e9 \U0001F680");
}

TEST(InputText, AHugeKeyIsAShortError) {
  const std::string huge(1'000'000, 'k');
  for (const std::string& text : {huge + " = 1\n" + small_scene, "[" + huge + "]\n",
                                  "friction.closure = \"" + huge + "\"\n" + small_scene,
                                  "load.peak = \"1 " + huge + "\"\n", "title = [\"" + huge + "\"]"})
    EXPECT_LT(error_of(text).message().size(), 6000u);
}

TEST(InputText, MessagesAreOneLineWithWholeLetters) {
  const std::string message =
      error_at({"a\nb.toml", 3}, "key\r\n\x1b[31m", "\"\t\x7f\"", std::string(9999, 'x')).message();
  EXPECT_LT(message.size(), 5000u);
  for (const char* part : {"\n", "\r", "\x1b", "\t", "\x7f"})
    EXPECT_EQ(message.find(part), std::string::npos) << message;
  const std::string letters = repeated("\u00e9", 300);
  for (std::size_t longest = 20; longest < 40; ++longest) {
    const std::string cut = quotable(letters, longest);
    EXPECT_LE(cut.size(), longest);
    EXPECT_NO_THROW(parse_toml("a = '" + cut + "'", "cut.toml")) << cut;
  }
  EXPECT_EQ(quotable("as it is", 20), "as it is");
  // toml++ takes the logarithm of 4.9e-324, of which 5e-324 is the shortest name, for a length.
  EXPECT_EQ(found_text(*parse_toml("a = [4.9e-324, 0.01]", "shell.toml").get("a")), "[ 5e-324, 0.01 ]");
}

class ReadTextFile : public testing::TemporaryFolder {
 protected:
  InputError error(const std::string& name, std::size_t largest = largest_input) const {
    const auto text = caught([&] { return read_text_file(folder() / name, largest); });
    EXPECT_FALSE(text) << name;
    return text ? InputError{} : text.error();
  }
};

TEST_F(ReadTextFile, ReadsRegularFilesOfALargestSize) {
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe", folder() / "link");
  for (const char* endless : {"pipe", "link", "/dev/zero"})
    EXPECT_EQ(error(endless).found, "a pipe or a device");
  EXPECT_EQ(error("").found, "a folder");
  EXPECT_TRUE(error("none").file_missing);
  std::ofstream(folder() / "file") << "text";
  std::filesystem::create_symlink("file", folder() / "good_link");
  EXPECT_EQ(read_text_file(folder() / "good_link", 4), "text");
  EXPECT_NE(error("file", 3).found, "");
  std::filesystem::create_symlink("self", folder() / "self");
  EXPECT_NE(error("self").found, "");
  std::filesystem::resize_file(folder() / "file", largest_input + 1);  // takes no room on the disk
  EXPECT_NE(error("file").found.find("16 MiB"), std::string::npos);
}

TEST_F(ReadTextFile, AMissingFileIsSuggestedFromItsFolder) {
  std::ofstream(folder() / "scene.tom") << "text";
  EXPECT_EQ(error("scene.tml").suggestion, '"' + (folder() / "scene.tom").string() + '"');
  EXPECT_EQ(error("quite different").suggestion, "");
}

}  // namespace
}  // namespace launchsafe::scene
