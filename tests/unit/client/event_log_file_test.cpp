// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/log/event_log_file.hpp"

#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <sys/resource.h>

#include <csignal>
#include <memory>

#include "client/log/recorder.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

struct Event {
  std::int64_t number, utime;
  std::string channel, data;
  bool operator==(const Event&) const = default;
};

/// As LCM's own reader sees a log.
std::vector<Event> read_log(const std::filesystem::path& path) {
  const std::unique_ptr<lcm_eventlog_t, void (*)(lcm_eventlog_t*)> log(lcm_eventlog_create(path.c_str(), "r"),
                                                                       lcm_eventlog_destroy);
  std::vector<Event> events;
  if (!log) return events;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log.get())) {
    events.push_back(
        {event->eventnum, event->timestamp,
         std::string(event->channel, static_cast<std::size_t>(event->channellen)),
         std::string(static_cast<const char*>(event->data), static_cast<std::size_t>(event->datalen))});
    lcm_eventlog_free_event(event);
  }
  return events;
}

std::span<const std::byte> bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(EventLogFile, LcmReadsWhatWasWritten) {
  const TempFolder folder;
  const std::string big(100'000, 'z');
  {
    EventLogFile log(folder / "a.log", EventLogFile::Existing::kRefuse);
    log.write(1'700'000'000'000'001, "GRASPD_CLOUD", bytes(big));
    log.write(1'700'000'000'000'002, "GRASPD_HANDLES", bytes(std::string("\0\xff", 2)));
    log.write(-5, "X", bytes(""));
    EXPECT_EQ(log.size(), static_cast<std::int64_t>(std::filesystem::file_size(folder / "a.log")));
  }
  const std::vector<Event> expected{{0, 1'700'000'000'000'001, "GRASPD_CLOUD", big},
                                    {1, 1'700'000'000'000'002, "GRASPD_HANDLES", std::string("\0\xff", 2)},
                                    {2, -5, "X", ""}};
  EXPECT_EQ(read_log(folder / "a.log"), expected);
}

TEST(EventLogFile, IsReadableWhileItIsWritten) {
  const TempFolder folder;
  EventLogFile log(folder / "a.log", EventLogFile::Existing::kRefuse);
  for (int i = 0; i < 5; ++i) {
    log.write(i, "A", bytes("data"));
    EXPECT_EQ(read_log(folder / "a.log").size(), static_cast<std::size_t>(i + 1));
  }
}

TEST(EventLogFile, DoesNotOverwriteUnlessTold) {
  const TempFolder folder;
  write_bytes(folder / "a.log", "precious");
  try {
    EventLogFile log(folder / "a.log", EventLogFile::Existing::kRefuse);
    FAIL();
  } catch (const EventLogError& error) {
    EXPECT_EQ(error.what(), (folder / "a.log").string() + ": the log cannot be created: File exists");
  }
  EXPECT_EQ(read_bytes(folder / "a.log"), "precious");
  EventLogFile log(folder / "a.log", EventLogFile::Existing::kOverwrite);
  EXPECT_EQ(read_bytes(folder / "a.log"), "");
}

TEST(EventLogFile, WhereItCannotBeIsSaid) {
  EXPECT_THROW(EventLogFile("/no/such/folder/a.log", EventLogFile::Existing::kRefuse), EventLogError);
  EventLogFile full("/dev/full", EventLogFile::Existing::kOverwrite);
  try {
    full.write(1, "A", bytes("data"));
    FAIL();
  } catch (const EventLogError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: the log cannot be written: No space left on device");
  }
}

/// Files of this process cannot grow beyond a size, as on a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST(EventLogFile, EndsWithTheLastWholeEventWhenTheDiskIsFull) {
  const TempFolder folder;
  const std::string data(3000, 'd');
  {
    const FileSizeLimit limit(10'000);
    EventLogFile log(folder / "a.log", EventLogFile::Existing::kRefuse);
    for (int i = 0; i < 3; ++i) log.write(i, "A", bytes(data));
    EXPECT_THROW(log.write(3, "A", bytes(data)), EventLogError);
    log.write(4, "A", bytes("small"));
  }
  const auto events = read_log(folder / "a.log");
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[2].data, data);
  EXPECT_EQ(events[3].data, "small");
}

TEST(Recorder, RotatesBySize) {
  const TempFolder folder;
  const std::string data(1000, 'd');
  const std::int64_t size = event_size("A", bytes(data));
  Recorder recorder({folder / "run.log", 3 * size, 0, EventLogFile::Existing::kRefuse});
  for (int i = 0; i < 8; ++i) recorder.record(i, "A", bytes(data));
  EXPECT_EQ(recorder.files(), 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "run.log"));
  std::vector<std::int64_t> times;
  for (const auto& [name, count] : {std::pair{"run.log.00", 3u}, {"run.log.01", 3u}, {"run.log.02", 2u}}) {
    const auto events = read_log(folder / name);
    EXPECT_EQ(events.size(), count) << name;
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(events[i].number, static_cast<std::int64_t>(i)) << "each file stands alone";
      times.push_back(events[i].utime);
    }
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Recorder, AnEventLargerThanAFileGetsAFileOfItsOwn) {
  const TempFolder folder;
  Recorder recorder({folder / "run.log", 100, 0, EventLogFile::Existing::kRefuse});
  const std::string data(1000, 'd');
  recorder.record(1, "A", bytes(data));
  recorder.record(2, "A", bytes(data));
  EXPECT_EQ(recorder.files(), 2);
  EXPECT_EQ(read_log(folder / "run.log.01").size(), 1u);
}

TEST(Recorder, NamesGrowBeyondTwoDigits) {
  EXPECT_EQ(rotated_path("a/b.log", 0), "a/b.log.00");
  EXPECT_EQ(rotated_path("a/b.log", 99), "a/b.log.99");
  EXPECT_EQ(rotated_path("a/b.log", 100), "a/b.log.100");
}

TEST(Recorder, StopsBeforeTheDiskIsFull) {
  const TempFolder folder;
  const std::string data(1000, 'd');
  std::int64_t free = 5'000'000 + 2500;
  Recorder recorder({folder / "run.log", 0, 5'000'000, EventLogFile::Existing::kRefuse},
                    [&](const std::filesystem::path&) { return free; });
  for (int i = 0; i < 2; ++i) {
    recorder.record(i, "A", bytes(data));
    free -= event_size("A", bytes(data));
  }
  try {
    recorder.record(2, "A", bytes(data));
    FAIL();
  } catch (const EventLogError& error) {
    EXPECT_EQ(error.what(),
              (folder / "run.log").string() +
                  ": recording stopped: 5.0 MB would be left on the disk, at least 5.0 MB are to stay free");
  }
  EXPECT_EQ(read_log(folder / "run.log").size(), 2u);
  EXPECT_EQ(recorder.total().events, 2);
}

TEST(Recorder, ARealDiskHasRoom) {
  const TempFolder folder;
  EXPECT_GT(Recorder::free_bytes_of_disk(folder.path()), 0);
  EXPECT_THROW((void)Recorder::free_bytes_of_disk(folder / "missing"), EventLogError);
}

TEST(Recorder, CountsByChannel) {
  const TempFolder folder;
  Recorder recorder({folder / "run.log", 0, 0, EventLogFile::Existing::kRefuse});
  recorder.record(1, "B", bytes("12345"));
  recorder.record(2, "A", bytes("123"));
  recorder.record(3, "B", bytes("1"));
  ASSERT_EQ(recorder.channels().size(), 2u);
  EXPECT_EQ(recorder.channels().at("A").events, 1);
  EXPECT_EQ(recorder.channels().at("B").events, 2);
  EXPECT_EQ(recorder.channels().at("B").bytes, 6);
  EXPECT_EQ(recorder.total().bytes, 9);
}

}  // namespace
}  // namespace graspd
