// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// The log that a replay writes: never there in part, and continued where a stopped run has left it.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "client/log/event_log_file.hpp"
#include "client/replay/replay_state.hpp"
#include "service/transport/file_descriptor.hpp"

namespace graspd {

/// What is there already.
enum class OldOutput { kRefuse, kOverwrite, kResume };

/// FILE appears when it is complete. Until then its events are in FILE.part, FILE.progress says which of them
/// count, and FILE.lock keeps a second writer away. FILE.receipt stays beside it.
class ReplayOutput {
 public:
  /// Throws EventLogError when there is something that must not be replaced, or somebody else writes it.
  ReplayOutput(std::filesystem::path file, std::string identity, OldOutput old);

  /// The receipt of an output that was complete before: there is nothing to do.
  [[nodiscard]] const std::optional<Receipt>& complete() const { return complete_; }
  /// What the run goes on from.
  [[nodiscard]] const ReplayState& start() const { return start_; }

  void write(std::int64_t recv_utime, std::string_view channel, std::span<const std::byte> bytes) {
    log_->write(recv_utime, channel, bytes);
  }
  /// Makes sure that a run that is stopped from now on goes on from `state`, whose output members are set.
  void checkpoint(ReplayState state);
  /// Checks what is on the disk, writes the receipt and gives the file its name.
  Receipt finish(ReplayState state);

 private:
  void lock();
  void open(OldOutput old);
  [[nodiscard]] std::filesystem::path beside(const char* ending) const { return file_.string() + ending; }

  std::filesystem::path file_;
  std::string identity_;
  FileDescriptor lock_;
  std::optional<Receipt> complete_;
  ReplayState start_;
  std::unique_ptr<EventLogFile> log_;
};

}  // namespace graspd
