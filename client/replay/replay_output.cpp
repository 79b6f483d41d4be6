// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/replay_output.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "client/common/sha256.hpp"

namespace graspd {

ReplayOutput::ReplayOutput(std::filesystem::path file, std::string identity, OldOutput old)
    : file_(std::move(file)),
      identity_(std::move(identity)),
      lock_(::open(beside(".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  lock();
  if (old == OldOutput::kOverwrite) {
    for (const char* ending : {"", ".receipt", ".progress", ".part"}) std::filesystem::remove(beside(ending));
  } else if (std::filesystem::exists(file_)) {
    const auto receipt = old == OldOutput::kResume ? load_receipt(beside(".receipt")) : std::nullopt;
    std::error_code error;
    if (!receipt || receipt->identity != identity_ ||
        static_cast<std::int64_t>(std::filesystem::file_size(file_, error)) != receipt->state.output_bytes)
      throw EventLogError(file_.string() + ": exists" +
                          (old == OldOutput::kResume ? ", and is not what this run writes" : "") +
                          " (--overwrite replaces it)");
    complete_ = receipt;
    for (const char* ending : {".progress", ".lock"}) std::filesystem::remove(beside(ending));
    return;
  }
  open(old);
}

void ReplayOutput::lock() {
  if (lock_.get() < 0)
    throw EventLogError(file_.string() + ": the log cannot be created: " + std::strerror(errno));
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0)
    throw EventLogError(file_.string() + ": another process is writing it");
}

void ReplayOutput::open(OldOutput old) {
  const std::filesystem::path part = beside(".part");
  if (old == OldOutput::kRefuse && std::filesystem::exists(part))
    throw EventLogError(part.string() + ": a run was stopped (--resume goes on, --overwrite begins anew)");
  if (const auto state = load_state(beside(".progress"), identity_); state && std::filesystem::exists(part)) {
    start_ = *state;
    log_ = std::make_unique<EventLogFile>(part, start_.output_bytes, start_.output_events);
    return;
  }
  log_ = std::make_unique<EventLogFile>(part, EventLogFile::Existing::kOverwrite);
  checkpoint(start_);
}

void ReplayOutput::checkpoint(ReplayState state) {
  state.output_bytes = log_->size();
  state.output_events = log_->events();
  log_->sync();
  save_state(beside(".progress"), identity_, state);
}

Receipt ReplayOutput::finish(ReplayState state) {
  state.output_bytes = log_->size();
  state.output_events = log_->events();
  log_->sync();
  log_.reset();
  const Receipt receipt{identity_, std::move(state), sha256_of_file(beside(".part"))};
  save_receipt(beside(".receipt"), receipt);
  std::filesystem::rename(beside(".part"), file_);
  for (const char* ending : {".progress", ".lock"}) std::filesystem::remove(beside(ending));
  return receipt;
}

}  // namespace graspd
