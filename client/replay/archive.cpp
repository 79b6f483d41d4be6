// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/replay/archive.hpp"

#include <algorithm>
#include <utility>

namespace graspd {

Archive::Archive(std::vector<LogPart> parts, const ArchivePosition& start)
    : parts_(std::move(parts)), part_(start.part), skipped_before_(start.skipped) {
  for (const LogPart& part : parts_) {
    const std::int64_t size = EventLogReader(part.path).size();
    sizes_.push_back(std::min(part.part.end, size) - std::min(part.part.begin, size));
    bytes_in_all_ += sizes_.back();
  }
  for (std::size_t i = 0; i < std::min(part_, sizes_.size()); ++i) bytes_before_ += sizes_[i];
  if (part_ < parts_.size()) open(start.offset);
}

void Archive::open(std::int64_t offset) {
  EventLogReader::Part part = parts_[part_].part;
  if (offset >= 0) part.begin = offset;
  reader_ = std::make_unique<EventLogReader>(parts_[part_].path, part);
}

bool Archive::next_head(EventHead& head) {
  while (reader_) {
    if (reader_->next_head(head)) return true;
    if (part_ + 1 == parts_.size()) return false;
    skipped_before_ += reader_->skipped_bytes();
    bytes_before_ += sizes_[part_];
    ++part_;
    open(-1);
  }
  return false;
}

ArchivePosition Archive::position() const {
  if (!reader_) return {part_, -1, skipped_before_};
  return {part_, reader_->position(), skipped_before_ + reader_->skipped_bytes()};
}

std::int64_t Archive::reader_position() const {
  return reader_ ? reader_->position() - parts_[part_].part.begin : 0;
}

}  // namespace graspd
