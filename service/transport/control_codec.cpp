// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/control_codec.hpp"

#include "service/transport/byte_reader.hpp"
#include "service/transport/encoding.hpp"
#include "service/transport/message_parts.hpp"
#include "service/transport/wire_layout.hpp"

namespace graspd {

void encode(const control_t& control, std::vector<std::byte>& buffer) {
  encode_message(control, buffer);
}

std::vector<std::byte> encode(const control_t& control) {
  return encoded(control);
}

std::optional<control_t> decode_control(std::span<const std::byte> message) {
  if (fingerprint(message) != kControlFingerprint) return std::nullopt;
  ByteReader reader(message.subspan(kFingerprintBytes));
  control_t control;
  control.utime = reader.int64("utime");
  control.id = reader.int64("id");
  control.command = reader.int8("command");
  control.text = reader.string("text", kMaxOverridesLength);
  reader.finish();
  const bool known = control.command >= control_t::RELOAD && control.command <= control_t::RESET;
  if (!reader.ok() || !known || control.id <= 0) return std::nullopt;
  return control;
}

}  // namespace graspd
