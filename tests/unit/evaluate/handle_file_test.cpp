// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/evaluate/handle_file.hpp"

#include <gtest/gtest.h>

#include "client/common/handle_csv.hpp"
#include "tests/support/temp_folder.hpp"

namespace graspd {
namespace {

handle_list_t list_of(const std::string& frame, std::int64_t seq, int handles) {
  handle_list_t list{};
  list.frame_name = frame;
  list.seq = seq;
  for (int i = 0; i < handles; ++i) {
    handle_t handle{};
    handle.id = i;
    handle.position[0] = 0.125 * (i + 1);
    handle.orientation[0] = 0.5;
    handle.orientation[1] = -0.5;
    handle.orientation[2] = 0.5;
    handle.orientation[3] = 0.5;
    handle.width = 0.05;
    handle.score = 0.75;
    list.handles.push_back(handle);
  }
  list.num_handles = handles;
  return list;
}

/// The line that reading fails with; "read" when it does not.
std::string failure(const std::string& text) {
  const TempFolder folder;
  write_bytes(folder / "h.csv", text);
  try {
    (void)read_handle_file(folder / "h.csv");
  } catch (const CsvError& error) {
    std::string line = error.what();
    return line.substr(line.find("h.csv"));
  }
  return "read";
}

const std::string kHeader = "frame,px,py,pz,qw,qx,qy,qz,width\n";

TEST(HandleFile, ReadsWhatTheProgramsWrite) {
  const TempFolder folder;
  write_bytes(folder / "h.csv", handle_csv_header() + handle_csv_rows(list_of("odd, \"name\"", 7, 2)) +
                                    handle_csv_rows(list_of("b", 8, 0), EmptyLists::kWriteRow));
  const HandleFile file = read_handle_file(folder / "h.csv");
  const auto* handles = file.find("odd, \"name\"");
  ASSERT_TRUE(handles);
  ASSERT_EQ(handles->size(), 2u);
  EXPECT_EQ((*handles)[0].position.x(), 0.125f);
  EXPECT_EQ((*handles)[1].position.x(), 0.25f);
  EXPECT_EQ((*handles)[0].width_m, 0.05f);
  EXPECT_EQ((*handles)[0].score, 0.75f);
  const Eigen::Quaternionf q(0.5f, -0.5f, 0.5f, 0.5f);
  EXPECT_TRUE((*handles)[0].rotation.isApprox(q.toRotationMatrix()));
  ASSERT_TRUE(file.find(std::int64_t{7}));
  EXPECT_EQ(file.find(std::int64_t{7})->size(), 2u);
  ASSERT_TRUE(file.find("b"));
  EXPECT_TRUE(file.find("b")->empty());
  EXPECT_FALSE(file.find("c"));
  EXPECT_FALSE(file.find(std::int64_t{9}));
}

TEST(HandleFile, ColumnsInAnyOrderAndOthersToo) {
  const TempFolder folder;
  write_bytes(folder / "h.csv",
              "\xef\xbb\xbfwidth,qz,qy,qx,qw,comment,pz,py,px,frame\r\n0.05,0,0,0,1,\"x\ny\",3,2,1,a\r\n");
  const HandleFile file = read_handle_file(folder / "h.csv");
  ASSERT_TRUE(file.find("a"));
  EXPECT_TRUE(file.find("a")->at(0).position.isApprox(Eigen::Vector3f(1, 2, 3)));
}

TEST(HandleFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(failure(""), "h.csv:1: has no column `frame`");
  EXPECT_EQ(failure("frame,px\n"), "h.csv:1: has no column `py`");
  EXPECT_EQ(failure(kHeader), "read");
  EXPECT_EQ(failure(kHeader + "a,1,2\n"), "h.csv:2: has 3 cells, expected 9");
  EXPECT_EQ(failure(kHeader + "a,0,0,0,1,0,0,0,0.05\na,0,0,x,1,0,0,0,0.05\n"),
            "h.csv:3: pz is no finite number (got 'x')");
  EXPECT_EQ(failure(kHeader + "a,0,0,nan,1,0,0,0,0.05\n"), "h.csv:2: pz is no finite number (got 'nan')");
  EXPECT_EQ(failure(kHeader + "a,0,0,0,0,0,0,0,0.05\n"), "h.csv:2: qw, qx, qy, qz are no rotation");
  EXPECT_EQ(failure(kHeader + "\"a,0,0,0,1,0,0,0,0.05\n"), "h.csv:2: a quote is never closed");
}

TEST(HandleFile, FilesThatAreNone) {
  const TempFolder folder;
  EXPECT_THROW((void)read_handle_file(folder / "none.csv"), CsvError);
  EXPECT_THROW((void)read_handle_file(folder.path()), CsvError);
}

TEST(HandleFile, GraspableObjectsHaveEnoughPoses) {
  const TempFolder folder;
  write_bytes(folder / "g.csv", "frame,object,points,poses\na,2,100,3\na,3,100,2\nb,2,100,0\n");
  const auto graspable = read_graspable_file(folder / "g.csv");
  ASSERT_EQ(graspable.size(), 2u);
  EXPECT_EQ(graspable.at("a"), std::set<int>{2});
  EXPECT_TRUE(graspable.at("b").empty());
}

TEST(HandleFile, Categories) {
  const TempFolder folder;
  write_bytes(folder / "c.csv", "frame,category\na,boxes\nb,\"cans, bottles\"\n");
  const auto categories = read_category_file(folder / "c.csv");
  EXPECT_EQ(categories.at("a"), "boxes");
  EXPECT_EQ(categories.at("b"), "cans, bottles");
}

}  // namespace
}  // namespace graspd
