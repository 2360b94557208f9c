#include "launchsafe/store/sha256.hpp"

#include "sha256_blocks.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace launchsafe::store {
namespace {

std::uint32_t big_endian_word(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
         bytes[3];
}

std::array<std::uint32_t, 64> message_schedule(const unsigned char* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 16; ++i) w[i] = big_endian_word(block + 4 * i);
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  return w;
}

void compress_block(std::array<std::uint32_t, 8>& state, const unsigned char* block) {
  const auto w = message_schedule(block);
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t choice = (e & f) ^ (~e & g);
    const std::uint32_t t1 = h + s1 + choice + sha256_round_constants[i] + w[i];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + s0 + majority;
  }
  const std::array<std::uint32_t, 8> added{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += added[i];
}

void compress_portably(std::array<std::uint32_t, 8>& state, const unsigned char* blocks, std::size_t count) {
  for (std::size_t block = 0; block < count; ++block) compress_block(state, blocks + 64 * block);
}

}  // namespace

Sha256::Sha256(Code code)
    : compress_(code == Code::fastest && has_sha_instructions() ? compress_by_instructions
                                                                : compress_portably) {}

void Sha256::update(std::string_view bytes) {
  const std::size_t used = bytes_ % buffer_.size();
  bytes_ += bytes.size();
  if (used > 0) {
    const std::size_t taken = std::min(buffer_.size() - used, bytes.size());
    std::memcpy(buffer_.data() + used, bytes.data(), taken);
    bytes.remove_prefix(taken);
    if (used + taken < buffer_.size()) return;
    compress_(state_, buffer_.data(), 1);
  }
  const std::size_t blocks = bytes.size() / buffer_.size();
  compress_(state_, reinterpret_cast<const unsigned char*>(bytes.data()), blocks);
  bytes.remove_prefix(blocks * buffer_.size());
  std::copy(bytes.begin(), bytes.end(), buffer_.begin());
}

std::string Sha256::finish() {
  const std::uint64_t bits = bytes_ * 8;
  const std::size_t used = bytes_ % 64;
  std::string padding(used < 56 ? 64 - used : 128 - used, '\0');
  padding.front() = '\x80';
  for (std::size_t i = 0; i < 8; ++i) {
    padding[padding.size() - 1 - i] = static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  }
  update(padding);
  constexpr std::string_view hex_digits = "0123456789abcdef";
  std::string text;
  for (const std::uint32_t word : state_) {
    for (int shift = 28; shift >= 0; shift -= 4) text += hex_digits[(word >> shift) & 0xf];
  }
  return text;
}

std::string sha256(std::string_view bytes) {
  Sha256 digest;
  digest.update(bytes);
  return digest.finish();
}

}  // namespace launchsafe::store
