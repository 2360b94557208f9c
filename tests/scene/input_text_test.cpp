// Texts that would exhaust a reader: nesting, huge keys, other encodings.
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace launchsafe::scene {
namespace {

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

InputError toml_error(const std::string& text) {
  const auto table = parse_toml(text, "shell.toml");
  EXPECT_FALSE(table) << text.substr(0, 100);
  return table ? InputError{} : table.error();
}

// A hundred thousand levels need more stack than there is.
TEST(InputText, DeepNestingIsAnErrorWithItsLine) {
  constexpr std::size_t deep = 100'000;
  for (const std::string& text :
       {"x = 1\na = " + repeated("[", deep), "x = 1\na = " + repeated("[", deep) + repeated("]", deep),
        "x = 1\n" + repeated("[", deep),
        "x = 1\na = " + repeated("{ a = ", deep) + "1" + repeated(" }", deep),
        "x = 1\na = " + repeated("[ { a = ", deep)}) {
    const InputError error = toml_error(text);
    EXPECT_EQ(error.line, 2) << error.message();
  }
}

TEST(InputText, AHugeKeyIsAShortError) {
  const std::string huge(1'000'000, 'k');
  for (const std::string& text :
       {huge + " = 1\n" + small_scene, "load." + huge + " = 1\n" + small_scene,
        "\"" + huge + "\" = 1\n" + small_scene, "[" + huge + "]\n",
        "friction.closure = \"" + huge + "\"\n" + small_scene, "title = " + huge,
        "load.peak = \"" + huge + "\"\n", "load.peak = \"1 " + huge + "\"\n", "title = [\"" + huge + "\"]"}) {
    const InputError error = error_of(text);
    EXPECT_LT(error.message().size(), 6000u);
    EXPECT_LT(error.found.size(), 300u);
    EXPECT_LT(error.key.size(), 300u);
  }
}

TEST(InputText, WhatIsNoUtf8IsAnErrorWithItsPlace) {
  for (const std::string& bytes :
       {std::string("\xE4"), std::string("\xC0\x80"), std::string("\xED\xA0\x80"),
        std::string("\xF4\x90\x80\x80"), std::string("\xE2\x82"), std::string(1, '\0')}) {
    const InputError error = toml_error("x = 1\n# \u20ac " + bytes + "\n");
    EXPECT_EQ(error.line, 2) << error.message();
  }
  EXPECT_TRUE(parse_toml("\xEF\xBB\xBFtitle = '\U0001F680 \u20ac'\n", "shell.toml"));  // a byte-order mark
}

TEST(InputText, MessagesAreOneLineOfLimitedLength) {
  const InputError error =
      error_at({"a\nb.toml", 3}, "key\r\n\x1b[31m", "\"\t\x7f\"", std::string(9999, 'x'));
  const std::string message = error.message();
  EXPECT_LT(message.size(), 5000u);
  for (const char* part : {"\n", "\r", "\x1b", "\t", "\x7f"})
    EXPECT_EQ(message.find(part), std::string::npos) << message;
  EXPECT_NE(message.find("\\n"), std::string::npos) << message;
  // Letters beyond ASCII stay whole where a text is cut.
  std::string letters;
  for (int i = 0; i < 300; ++i) letters += "\u00e9";
  for (std::size_t longest = 20; longest < 40; ++longest) {
    const std::string cut = quotable(letters, longest);
    EXPECT_LE(cut.size(), longest);
    EXPECT_TRUE(parse_toml("a = '" + cut + "'", "cut.toml")) << cut;
  }
  EXPECT_EQ(quotable("as it is", 20), "as it is");
}

}  // namespace
}  // namespace launchsafe::scene
