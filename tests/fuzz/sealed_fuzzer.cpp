// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "service/transport/seal_verifier.hpp"
#include "service/transport/wire_layout.hpp"
#include "tests/fuzz/fuzzer.hpp"

namespace graspd {
namespace {

constexpr std::int64_t kNow = 1'700'000'000'000'000;

/// Nobody without the key gets anything through.
void check_forgery(const std::vector<std::byte>& message, SealVerifier& verifier) {
  const auto opened = verifier.open("CLOUD", message, kNow);
  require(std::holds_alternative<Refusal>(opened));
}

/// What was sealed comes out as it went in, once, on its channel alone.
void check_round_trip(const std::vector<std::byte>& message, const SealKey& key, SealVerifier& verifier) {
  std::vector<std::byte> sealed;
  static std::int64_t seq = 0;
  seal(key, {1, ++seq, kNow}, "CLOUD", message, sealed);
  require(std::holds_alternative<Refusal>(verifier.open("OTHER", sealed, kNow)));
  const auto opened = verifier.open("CLOUD", sealed, kNow);
  const auto* inside = std::get_if<std::span<const std::byte>>(&opened);
  require(inside != nullptr && std::equal(inside->begin(), inside->end(), message.begin(), message.end()));
  require(std::holds_alternative<Refusal>(verifier.open("CLOUD", sealed, kNow)));
}

}  // namespace
}  // namespace graspd

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const SealKey key{{1, 2, 3}};
  static SealVerifier verifier({key}, 1'000'000);
  const auto message = message_of(kSealedFingerprint, data, size);
  check_forgery(message, verifier);
  check_round_trip(message, key, verifier);
  return 0;
}
