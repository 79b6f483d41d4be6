// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/table/handle_tables_reader.hpp"

#include <gtest/gtest.h>

#include "client/simulate/rng.hpp"
#include "client/table/handle_tables.hpp"
#include "service/transport/handle_list_codec.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

handle_t random_handle(Rng& rng, std::int32_t rank) {
  handle_t h{};
  h.id = rank;
  h.segment_id = rng.index(100);
  for (auto* values : {h.position, h.rpy, h.approach, h.closing_axis, h.major_axis})
    for (int i = 0; i < 3; ++i) values[i] = rng.normal();
  for (double& value : h.orientation) value = rng.normal();
  h.width = rng.uniform();
  for (int i = 0; i < 2; ++i) {
    h.gap[i] = rng.uniform();
    h.observed_free[i] = rng.uniform();
  }
  h.num_points = rng.index(5000);
  h.score = rng.uniform();
  return h;
}

handle_list_t random_list(Rng& rng) {
  handle_list_t list{};
  list.utime = static_cast<std::int64_t>(rng.bits() >> 2);
  list.seq = rng.index(1000) - 1;
  list.source_channel = "CAMERA_" + std::to_string(rng.index(3));
  list.frame_name = "base";
  list.gripper = {"hand", 0.1, 0.01, 0.02, 0.05, 0.03, 0.012};
  list.status = static_cast<std::int8_t>(rng.index(8));
  list.status_text = "why";
  list.config_revision = 3;
  list.voxel_size = 0.003;
  list.degraded = 1;
  list.points_in = 11;
  list.points_used = 12;
  list.num_segments = 13;
  list.num_candidates = 14;
  list.latency = rng.uniform();
  list.stages = {{}, {}};
  list.stages[0].milliseconds = 1.5;
  list.stages[1].milliseconds = 2;
  list.num_stages = 2;
  list.num_handles = rng.index(5);
  for (std::int32_t i = 0; i < list.num_handles; ++i) list.handles.push_back(random_handle(rng, i));
  return list;
}

/// What a table keeps of it.
handle_list_t kept(handle_list_t list) {
  round_as_in_tables(list);
  list.stages.resize(1);
  list.stages[0].milliseconds = 3.5;
  list.num_stages = 1;
  return list;
}

std::vector<handle_list_t> write_random_tables(const std::filesystem::path& file, int frames) {
  Rng rng(7);
  HandleTables tables(file);
  std::vector<handle_list_t> lists;
  for (int i = 0; i < frames; ++i) {
    lists.push_back(random_list(rng));
    tables.add(i, "HANDLES", lists.back());
  }
  tables.finish();
  return lists;
}

TEST(HandleTablesReader, GivesTheListsThatWereWritten) {
  const TempFolder folder;
  const auto lists = write_random_tables(folder / "t.parquet", 200);
  HandleTablesReader reader(folder / "t.parquet");
  ASSERT_EQ(reader.frames(), 200);
  for (const std::int64_t frame : {0, 199, 5, 6, 7, 100})
    EXPECT_EQ(encode(reader.list(frame)), encode(kept(lists[static_cast<std::size_t>(frame)]))) << frame;
}

TEST(HandleTablesReader, TablesOfDifferentRunsDoNotBelongTogether) {
  const TempFolder folder;
  (void)write_random_tables(folder / "a.parquet", 20);
  (void)write_random_tables(folder / "b.parquet", 30);
  EXPECT_THROW(HandleTablesReader(folder / "none.parquet"), std::runtime_error);
  std::filesystem::rename(folder / "b.frames.parquet", folder / "a.frames.parquet");
  EXPECT_THROW(HandleTablesReader(folder / "a.parquet"), std::runtime_error);
  std::filesystem::remove(folder / "a.frames.parquet");
  EXPECT_THROW(HandleTablesReader(folder / "a.parquet"), std::runtime_error);
}

/// Whatever becomes of a table: lists, or an error that says what.
void read_all(const std::filesystem::path& file) {
  try {
    HandleTablesReader reader(file);
    for (std::int64_t i = 0; i < std::min<std::int64_t>(reader.frames(), 50); ++i) (void)reader.list(i);
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(".parquet: "), std::string::npos) << error.what();
  }
}

TEST(HandleTablesReader, TakesWhateverBytesThereAre) {
  const TempFolder folder;
  (void)write_random_tables(folder / "t.parquet", 20);
  Rng rng(3);
  for (const char* name : {"t.parquet", "t.frames.parquet"}) {
    const std::string good = read_bytes(folder / name);
    for (int i = 0; i < 400; ++i) {
      std::string bad = good;
      // Most of it is compressed numbers: what says how they are to be read is at the end.
      const int from_end = rng.index(i % 2 == 0 ? static_cast<int>(good.size()) : 1200);
      bad[good.size() - 1 - static_cast<std::size_t>(from_end) % good.size()] = static_cast<char>(rng.bits());
      if (i % 5 == 0) bad.resize(static_cast<std::size_t>(rng.index(static_cast<int>(good.size()))));
      write_bytes(folder / name, bad);
      read_all(folder / "t.parquet");
    }
    write_bytes(folder / name, good);
  }
}

}  // namespace
}  // namespace graspd
