// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "graspd/sealed_t.hpp"
#include "service/transport/sealer.hpp"
#include "tests/unit/transport/message_samples.hpp"

namespace graspd {
namespace {

constexpr SealHeader kHeader{11, 22, 33};

SealKey key_of(unsigned char first) {
  SealKey key;
  key.bytes.fill(0x5a);
  key.bytes[0] = first;
  return key;
}

Bytes sealed(const SealKey& key, std::string_view channel, const Bytes& message) {
  Bytes bytes;
  seal(key, kHeader, channel, message, bytes);
  return bytes;
}

/// Why a message is refused; the reason's name, empty: it is not.
std::string refusal(const SealKey& key, std::string_view channel, const Bytes& bytes) {
  const auto result = unseal(std::span(&key, 1), channel, bytes);
  const auto* refused = std::get_if<Refusal>(&result);
  return refused != nullptr ? std::string(name(refused->reason)) : "";
}

TEST(Seal, GivesBackWhatWasSealed) {
  for (const Bytes& message : {Bytes{}, Bytes(1, std::byte{7}), raw_bytes(small_point_cloud())}) {
    const SealKey key = key_of(1);
    const Bytes bytes = sealed(key, "CLOUD", message);
    EXPECT_EQ(bytes.size(), message.size() + kSealBytes);
    const auto result = unseal(std::span(&key, 1), "CLOUD", bytes);
    const auto& opened = std::get<Unsealed>(result);
    EXPECT_TRUE(std::equal(opened.message.begin(), opened.message.end(), message.begin(), message.end()));
    EXPECT_EQ(opened.header.sender, 11);
    EXPECT_EQ(opened.header.seq, 22);
    EXPECT_EQ(opened.header.utime, 33);
  }
}

TEST(Seal, IsTheContractsType) {
  const Bytes message = raw_bytes(small_depth_image());
  const sealed_t decoded = generated_decode<sealed_t>(sealed(key_of(1), "CLOUD", message));
  EXPECT_EQ(decoded.key_id, key_of(1).id());
  EXPECT_EQ(decoded.sender, 11);
  EXPECT_EQ(decoded.seq, 22);
  EXPECT_EQ(decoded.utime, 33);
  EXPECT_EQ(decoded.payload_size, static_cast<int>(message.size()));
  EXPECT_EQ(raw_bytes(decoded), sealed(key_of(1), "CLOUD", message));
}

/// Computed with Python's hashlib.blake2b(key=..., digest_size=32), for senders in other languages.
TEST(Seal, MacIsKeyedBlake2b) {
  SealKey key;
  for (std::size_t i = 0; i < key.bytes.size(); ++i) key.bytes[i] = static_cast<unsigned char>(i);
  const Bytes bytes = sealed(key, "CLOUD", Bytes(3, std::byte{0x61}));
  std::string mac;
  for (const std::byte b : std::span(bytes).last(kMacBytes)) {
    constexpr const char* kDigits = "0123456789abcdef";
    mac += {kDigits[std::to_integer<int>(b) >> 4], kDigits[std::to_integer<int>(b) & 15]};
  }
  EXPECT_EQ(mac, "0a36ed7cec063690084aa4ef5e6f8814ddee24640e777fe4e3eb2a2982e5ad24");
  EXPECT_EQ(static_cast<std::uint64_t>(key.id()), 0xcb2f5160fc1f7e05u);
}

TEST(Seal, RefusesWhatIsNotSealed) {
  EXPECT_EQ(refusal(key_of(1), "CLOUD", raw_bytes(small_point_cloud())), "unsigned");
  EXPECT_EQ(refusal(key_of(1), "CLOUD", {}), "unsigned");
}

TEST(Seal, RefusesAnotherKeyOrChannel) {
  const Bytes bytes = sealed(key_of(1), "CLOUD", raw_bytes(small_point_cloud()));
  EXPECT_EQ(refusal(key_of(2), "CLOUD", bytes), "forged");
  EXPECT_EQ(refusal(key_of(1), "CLOUD2", bytes), "forged");
  EXPECT_EQ(refusal(key_of(1), "", bytes), "forged");
  EXPECT_EQ(refusal(key_of(1), "CLOUD", bytes), "");
}

TEST(Seal, RefusesEveryChangedByte) {
  const Bytes bytes = sealed(key_of(1), "CLOUD", raw_bytes(small_depth_image()));
  for_each_corruption(bytes, [&](const Bytes& bad) { EXPECT_NE(refusal(key_of(1), "CLOUD", bad), ""); });
}

TEST(Seal, RefusesEveryBeginning) {
  const Bytes bytes = sealed(key_of(1), "CLOUD", raw_bytes(small_depth_image()));
  for_each_truncation(bytes, [&](const Bytes& part) {
    EXPECT_EQ(refusal(key_of(1), "CLOUD", part), part.size() < 8 ? "unsigned" : "truncated") << part.size();
  });
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal(key_of(1), "CLOUD", longer), "trailing_bytes");
}

TEST(Seal, LyingSizesAreTruncated) {
  const Bytes bytes = sealed(key_of(1), "CLOUD", raw_bytes(small_depth_image()));
  for (const std::int64_t size : {-1LL, -2147483648LL, 2147483647LL}) {
    Bytes bad = bytes;
    put(bad, 40, size, 4);
    EXPECT_EQ(refusal(key_of(1), "CLOUD", bad), "truncated");
  }
}

TEST(Seal, TakesAnyOfSeveralKeys) {
  const std::vector<SealKey> keys{key_of(1), key_of(2)};
  for (const SealKey& key : keys) {
    const auto result = unseal(keys, "CLOUD", sealed(key, "CLOUD", raw_bytes(small_point_cloud())));
    EXPECT_TRUE(std::holds_alternative<Unsealed>(result));
  }
}

TEST(Sealer, CountsItsMessagesAndHasANumberOfItsOwn) {
  const SealKey key = key_of(1);
  Sealer first(key);
  Sealer second(key);
  const auto header = [&](Sealer& sealer) {
    const auto bytes = sealer.seal("CLOUD", raw_bytes(small_point_cloud()), 5);
    return std::get<Unsealed>(unseal(std::span(&key, 1), "CLOUD", bytes)).header;
  };
  const SealHeader a = header(first), b = header(first), c = header(second);
  EXPECT_EQ(a.sender, b.sender);
  EXPECT_NE(a.sender, c.sender);
  EXPECT_LT(a.seq, b.seq);
  EXPECT_EQ(a.utime, 5);
}

}  // namespace
}  // namespace graspd
