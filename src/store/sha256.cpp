#define OPENSSL_API_COMPAT 10101  // of the functions that load no providers, which takes a millisecond
#include "launchsafe/store/file.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <array>

namespace launchsafe::store {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256_CTX context;
  SHA256_Init(&context);
  SHA256_Update(&context, bytes.data(), bytes.size());
  SHA256_Final(digest.data(), &context);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace launchsafe::store
