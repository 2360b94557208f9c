// SHA-256 (FIPS 180-4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace launchsafe::store {

/// Digest of bytes that arrive in pieces.
class Sha256 {
 public:
  /// `fastest` uses the processor's own instructions for SHA-256 where it has them; the digest is the same.
  enum class Code { fastest, portable };
  explicit Sha256(Code code = Code::fastest);

  void update(std::string_view bytes);
  /// The digest of all bytes so far as 64 lower-case hexadecimal digits; ends the use of this object.
  std::string finish();

 private:
  using State = std::array<std::uint32_t, 8>;
  using Compress = void (*)(State& state, const unsigned char* blocks, std::size_t count);

  Compress compress_;
  State state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
               0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> buffer_{};
  std::uint64_t bytes_ = 0;
};

/// Digest of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace launchsafe::store
