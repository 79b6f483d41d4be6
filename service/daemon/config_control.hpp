// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// What a running daemon's configuration is made of, and how it changes.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "graspd/control_t.hpp"
#include "service/config/service_config.hpp"

namespace graspd {

/// A change is proposed, whole and checked, then accepted or refused; until then nothing has changed. Belongs
/// to one thread.
class ConfigControl {
 public:
  /// The configuration with these overrides; throws where it cannot be used.
  using Load = std::function<ServiceConfig(const std::string& overrides)>;
  /// SETs and RESETs that can be taken back.
  static constexpr std::size_t kMostUndos = 32;
  static constexpr std::size_t kLongestError = 1000;

  struct Proposal {
    ServiceConfig config;
    std::string overrides;
    std::vector<std::string> undos;  // overrides of before, oldest first
  };

  explicit ConfigControl(Load load) : load_(std::move(load)) {}

  /// The file again, with the overrides that there are.
  [[nodiscard]] Proposal propose_reload() const;
  [[nodiscard]] Proposal propose(const control_t& control) const;

  /// A revision more, and no error.
  void accept(Proposal proposal);
  /// The reason is kept up to kLongestError characters: a status holds no more.
  void refuse(const std::string& why) { error_ = why.substr(0, kLongestError); }
  /// The newest message that was answered, either way.
  void answered(std::int64_t control_id) { control_id_ = control_id; }

  [[nodiscard]] std::int64_t revision() const { return revision_; }
  [[nodiscard]] std::int64_t control_id() const { return control_id_; }
  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] const std::string& overrides() const { return overrides_; }

 private:
  const Load load_;
  std::string overrides_;
  std::vector<std::string> undos_;
  std::int64_t revision_ = 1;
  std::int64_t control_id_ = 0;
  std::string error_;
};

}  // namespace graspd
