// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal.hpp"

#include <sodium.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "service/transport/byte_reader.hpp"
#include "service/transport/decoding.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {
namespace {

constexpr std::string_view kType = "sealed_t";
using Mac = std::array<unsigned char, kMacBytes>;

static_assert(kMacBytes == crypto_generichash_blake2b_BYTES &&
              kSealKeyBytes == crypto_generichash_blake2b_KEYBYTES);

std::array<std::byte, 8> big_endian(std::uint64_t value) {
  std::array<std::byte, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::byte>((value >> (56 - 8 * i)) & 0xff);
  return bytes;
}

/// Copies to the front, and moves on behind it.
void put(std::span<std::byte>& to, std::span<const std::byte> bytes) {
  std::copy(bytes.begin(), bytes.end(), to.begin());
  to = to.subspan(bytes.size());
}

/// The channel's length comes first, so that no other split of name and message has the same MAC.
Mac mac_of(const SealKey& key, std::string_view channel, std::span<const std::byte> signed_part) {
  const auto add = [](crypto_generichash_blake2b_state& state, std::span<const std::byte> bytes) {
    crypto_generichash_blake2b_update(&state, reinterpret_cast<const unsigned char*>(bytes.data()),
                                      bytes.size());
  };
  crypto_generichash_blake2b_state state;
  Mac mac{};
  crypto_generichash_blake2b_init(&state, key.bytes.data(), key.bytes.size(), mac.size());
  add(state, big_endian(channel.size()));
  add(state, std::as_bytes(std::span(channel)));
  add(state, signed_part);
  crypto_generichash_blake2b_final(&state, mac.data(), mac.size());
  return mac;
}

struct Members {
  std::int64_t key_id = 0;
  SealHeader header;
  std::span<const std::byte> payload;
  std::span<const std::byte> mac;
};

Members read_members(ByteReader& reader) {
  Members m;
  reader.skip("fingerprint", kFingerprintBytes);
  m.key_id = reader.int64("key_id");
  m.header.sender = reader.int64("sender");
  m.header.seq = reader.int64("seq");
  m.header.utime = reader.int64("utime");
  // As a size that no message has when it is negative.
  const auto payload_size = static_cast<std::uint32_t>(reader.int32("payload_size"));
  m.payload = reader.bytes("payload", payload_size);
  m.mac = reader.bytes("mac", kMacBytes);
  reader.finish();
  return m;
}

Refusal refuse_seal(RefusalReason reason, std::string_view member, const std::string& what) {
  return refuse(reason, std::string(kType) + "." + std::string(member), what, {});
}

}  // namespace

std::int64_t SealKey::id() const {
  Mac hash{};
  crypto_generichash_blake2b(hash.data(), hash.size(), bytes.data(), bytes.size(), nullptr, 0);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 8; ++i) value = (value << 8) | hash[i];
  return static_cast<std::int64_t>(value);
}

void seal(const SealKey& key, const SealHeader& header, std::string_view channel,
          std::span<const std::byte> message, std::vector<std::byte>& sealed) {
  if (message.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("a message of " + std::to_string(message.size()) + " bytes cannot be sealed");
  sealed.resize(message.size() + kSealBytes);
  std::span<std::byte> left(sealed);
  put(left, big_endian(kSealedFingerprint));
  for (const std::int64_t value : {key.id(), header.sender, header.seq, header.utime})
    put(left, big_endian(static_cast<std::uint64_t>(value)));
  const auto payload_size = big_endian(message.size());
  put(left, std::span(payload_size).last(4));
  put(left, message);
  const Mac mac = mac_of(key, channel, std::span(sealed).first(sealed.size() - kMacBytes));
  put(left, std::as_bytes(std::span(mac)));
}

std::variant<Unsealed, Refusal> unseal(std::span<const SealKey> keys, std::string_view channel,
                                       std::span<const std::byte> sealed) {
  if (fingerprint(sealed) != kSealedFingerprint)
    return refuse_seal(RefusalReason::kUnsigned, "fingerprint",
                       "the message is not signed (expected sealed_t)");
  ByteReader reader(sealed);
  const Members m = read_members(reader);
  if (!reader.ok()) return refuse(reader, kType, {});
  const auto key =
      std::find_if(keys.begin(), keys.end(), [&](const SealKey& k) { return k.id() == m.key_id; });
  if (key == keys.end())
    return refuse_seal(RefusalReason::kForged, "key_id",
                       "no key of ours (got " + std::to_string(m.key_id) + ")");
  const Mac expected = mac_of(*key, channel, sealed.first(sealed.size() - kMacBytes));
  if (sodium_memcmp(expected.data(), m.mac.data(), expected.size()) != 0)
    return refuse_seal(RefusalReason::kForged, "mac",
                       "not what the key gives for this message on this channel");
  return Unsealed{m.header, m.payload};
}

}  // namespace graspd
