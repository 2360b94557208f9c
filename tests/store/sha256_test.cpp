#include "launchsafe/store/sha256.hpp"

#include <gtest/gtest.h>

namespace launchsafe::store {
namespace {

std::string portable_sha256(std::string_view bytes) {
  Sha256 digest(Sha256::Code::portable);
  digest.update(bytes);
  return digest.finish();
}

class Sha256Of : public ::testing::TestWithParam<std::string (*)(std::string_view)> {};

INSTANTIATE_TEST_SUITE_P(EitherCode, Sha256Of, ::testing::Values(&sha256, &portable_sha256),
                         [](const auto& code) { return code.index == 0 ? "Fastest" : "Portable"; });

TEST_P(Sha256Of, GivesTheDigestsOfTheStandard) {
  const auto digest_of = GetParam();
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(
      digest_of(
          "abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrs"
          "mnopqrstnopqrstu"),
      "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(digest_of(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheBytesArrive) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i);
  for (const std::size_t length : {0U, 1U, 55U, 56U, 63U, 64U, 65U, 119U, 120U, 128U, 300U}) {
    const std::string_view part = std::string_view(text).substr(0, length);
    Sha256 byte_by_byte;
    for (std::size_t i = 0; i < length; ++i) byte_by_byte.update(part.substr(i, 1));
    EXPECT_EQ(byte_by_byte.finish(), sha256(part)) << length;
  }
}

TEST(Sha256, IsTheSameByEitherCode) {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    text += static_cast<char>(i * i + 17 * i);
    ASSERT_EQ(sha256(text), portable_sha256(text)) << i;
  }
}

}  // namespace
}  // namespace launchsafe::store
