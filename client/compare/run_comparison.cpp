// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/compare/run_comparison.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "client/log/event_log_reader.hpp"
#include "client/table/handle_tables_reader.hpp"
#include "service/transport/handle_list_codec.hpp"

namespace graspd {
namespace {

/// Gives every list its key.
class Keys {
 public:
  FrameKey of(const handle_list_t& list) {
    FrameKey key{list.source_channel, list.utime, list.seq, 0};
    // Frames that could not be read all have the same; others come twice only where a log does.
    key.repeat = repeats_[key]++;
    return key;
  }

 private:
  std::map<FrameKey, std::int64_t> repeats_;
};

/// The handle lists of a log; a place is where an event begins.
class LogLists {
 public:
  explicit LogLists(const std::filesystem::path& path) : path_(path), reader_(path) {}

  std::optional<handle_list_t> next(std::int64_t& place) {
    EventHead head;
    std::vector<std::byte> message;
    while (reader_.next_head(head)) {
      reader_.read_message(message);
      if (auto list = decode_handle_list(message)) {
        place = head.position;
        return list;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] handle_list_t at(std::int64_t place) const {
    EventLogReader reader(path_, {place});
    LoggedEvent event;
    std::optional<handle_list_t> list;
    if (reader.next(event)) list = decode_handle_list(event.bytes);
    if (!list) throw EventLogError(path_.string() + ": the log cannot be read: it changes meanwhile");
    return *std::move(list);
  }

 private:
  std::filesystem::path path_;
  EventLogReader reader_;
};

/// The handle lists of tables; a place is a frame's number.
class TableLists {
 public:
  explicit TableLists(const std::filesystem::path& path) : reader_(path) {}

  std::optional<handle_list_t> next(std::int64_t& place) {
    if (next_ == reader_.frames()) return std::nullopt;
    place = next_;
    return reader_.list(next_++);
  }

  [[nodiscard]] handle_list_t at(std::int64_t place) { return reader_.list(place); }

 private:
  HandleTablesReader reader_;
  std::int64_t next_ = 0;
};

/// Of a run, whatever holds them.
class Lists {
 public:
  explicit Lists(const std::filesystem::path& path) : lists_(open(path)) {}

  /// Nothing at the end.
  std::optional<handle_list_t> next(std::int64_t& place) {
    return std::visit([&](auto& lists) { return lists.next(place); }, lists_);
  }
  handle_list_t at(std::int64_t place) {
    return std::visit([&](auto& lists) { return lists.at(place); }, lists_);
  }
  [[nodiscard]] bool from_table() const { return std::holds_alternative<TableLists>(lists_); }

 private:
  static std::variant<LogLists, TableLists> open(const std::filesystem::path& path) {
    if (is_parquet(path)) return TableLists(path);
    return LogLists(path);
  }

  std::variant<LogLists, TableLists> lists_;
};

std::vector<Quantity> no_quantities() {
  const auto quantity = [](const char* name, double step) {
    return Quantity{name, Distribution(step), Distribution(step)};
  };
  return {quantity("handles a frame", 1), quantity("best score", 0.005), quantity("score", 0.005),
          quantity("width [mm]", 0.5),    quantity("latency [ms]", 0.1), quantity("work [ms]", 0.1)};
}

void add_list(std::vector<Quantity>& quantities, Distribution Quantity::*run, const handle_list_t& list) {
  (quantities[0].*run).add(list.num_handles);
  if (!list.handles.empty()) (quantities[1].*run).add(list.handles.front().score);
  for (const handle_t& handle : list.handles) {
    (quantities[2].*run).add(handle.score);
    (quantities[3].*run).add(1e3 * handle.width);
  }
  double work_ms = 0;
  for (const stage_time_t& stage : list.stages) work_ms += stage.milliseconds;
  // A replay without --times has measured nothing.
  if (list.latency > 0) (quantities[4].*run).add(1e3 * list.latency);
  if (work_ms > 0) (quantities[5].*run).add(work_ms);
}

bool same_handles(handle_list_t a, handle_list_t b, bool as_in_tables) {
  for (handle_list_t* list : {&a, &b}) {
    if (as_in_tables) round_as_in_tables(*list);
    const auto handles = std::move(list->handles);
    const auto status = list->status;
    *list = handle_list_t{};
    list->status = status;
    list->handles = handles;
    list->num_handles = static_cast<std::int32_t>(handles.size());
    list->num_stages = list->num_candidate_failures = list->num_segment_failures = 0;
  }
  return encode(a) == encode(b);
}

void keep_worst(std::vector<ComparedFrame>& worst, ComparedFrame frame, std::size_t most) {
  const auto worse = [](const ComparedFrame& a, const ComparedFrame& b) {
    return a.difference.net_loss() > b.difference.net_loss();
  };
  worst.insert(std::upper_bound(worst.begin(), worst.end(), frame, worse), std::move(frame));
  if (worst.size() > most) worst.pop_back();
}

}  // namespace

RunComparison compare_runs(const std::filesystem::path& before, const std::filesystem::path& after,
                           const ComparisonOptions& options,
                           const std::function<void(const FrameDifference&)>& on_frame) {
  RunComparison result;
  result.quantities = no_quantities();
  std::map<FrameKey, std::int64_t> places;
  std::int64_t position = 0;
  Lists old_lists(before), lists(after);
  const bool as_in_tables = old_lists.from_table() || lists.from_table();
  {
    Keys keys;
    while (const auto list = old_lists.next(position)) {
      places.emplace(keys.of(*list), position);
      add_list(result.quantities, &Quantity::before, *list);
    }
  }
  Keys keys;
  for (std::int64_t number = 0; const auto list = lists.next(position); ++number) {
    add_list(result.quantities, &Quantity::after, *list);
    const FrameKey key = keys.of(*list);
    const auto place = places.find(key);
    if (place == places.end()) {
      ++result.only_after;
      continue;
    }
    const handle_list_t old = old_lists.at(place->second);
    places.erase(place);
    ++result.frames;
    FrameDifference d = difference(old, *list);
    d.key = key;
    d.frame = number;
    if (same_handles(old, *list, as_in_tables)) ++result.same;
    ++result.statuses[{d.status_before, d.status_after}];
    on_frame(d);
    if (d.net_loss() < -options.tolerance) ++result.better;
    if (d.net_loss() > options.tolerance) {
      ++result.worse;
      keep_worst(result.worst, {d, old, *list}, options.num_worst);
    }
  }
  result.only_before = std::ssize(places);
  return result;
}

}  // namespace graspd
