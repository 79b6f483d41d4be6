// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/detect_config.hpp"

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

#include "service/pipeline/gripper.hpp"

namespace graspd {
namespace {

/// Something that can initialise any field, to count the fields of an aggregate.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, class... Fields>
constexpr std::size_t num_fields() {
  if constexpr (requires { T{Fields{}..., Anything{}}; })
    return num_fields<T, Fields..., Anything>();
  else
    return sizeof...(Fields);
}

template <class T>
concept Nested = requires(const T& value) {
  T::visit(value, [](auto&&...) {});
};

/// Checks one struct after the other, and what it visits.
class Checker {
 public:
  template <class T>
  void check(const std::string& path, const T& config) {
    const std::string outer = std::exchange(path_, path);
    const std::size_t outer_count = std::exchange(count_, 0);
    T::visit(config, *this);
    // The one field that is not the user's to set.
    const std::size_t hidden = std::is_same_v<T, WorkspaceFilterConfig> ? 1 : 0;
    EXPECT_EQ(count_ + hidden, num_fields<T>()) << path << " does not visit every field, once";
    if constexpr (requires { config.validate(); }) {
      const auto problem = config.validate();
      EXPECT_FALSE(problem) << path << "." << problem->key << ": " << problem->reason;
    }
    path_ = outer;
    count_ = outer_count;
  }

  template <class T>
  void operator()(const char* key, const T& value, const char* documentation) {
    static_assert(Nested<T>);
    note(key, documentation);
    check(path_ + "." + key, value);
  }
  template <class T>
  void operator()(const char* key, const T& value, const Range& range, const char* documentation) {
    note(key, documentation);
    EXPECT_LT(range.min, range.max) << path_ << "." << key;
    if constexpr (std::is_arithmetic_v<T>)
      expect_in(key, static_cast<double>(value), range);
    else if constexpr (std::is_same_v<T, Eigen::Vector3f>)
      for (int i = 0; i < 3; ++i) expect_in(key, value[i], range);
    // The unit in the name is the unit in the text.
    const std::string name = key, text = documentation;
    if (name.ends_with("_m2")) {
      EXPECT_NE(text.find("m2"), std::string::npos) << path_ << "." << key;
    } else if (name.ends_with("_m")) {
      EXPECT_NE(text.find("[m]"), std::string::npos) << path_ << "." << key;
    } else if (name.ends_with("_deg")) {
      EXPECT_NE(text.find("[degrees]"), std::string::npos) << path_ << "." << key;
    }
  }

  [[nodiscard]] std::size_t num_keys() const { return keys_.size(); }

 private:
  void note(const char* key, const char* documentation) {
    ++count_;
    EXPECT_TRUE(keys_.insert(path_ + "." + key).second) << path_ << "." << key << " twice";
    EXPECT_FALSE(std::string(documentation).empty()) << path_ << "." << key;
  }
  void expect_in(const char* key, double value, const Range& range) const {
    EXPECT_GE(value, range.min) << path_ << "." << key;
    EXPECT_LE(value, range.max) << path_ << "." << key;
  }

  std::string path_;
  std::size_t count_ = 0;
  std::set<std::string> keys_;
};

TEST(DetectConfig, EveryFieldIsVisitedAndEveryDefaultIsValid) {
  Checker checker;
  checker.check("detect", DetectConfig{});
  EXPECT_GT(checker.num_keys(), 40u);
}

TEST(DetectConfig, TheGripperToo) {
  Checker checker;
  checker.check("gripper", Gripper{});
  EXPECT_EQ(checker.num_keys(), 7u);
}

TEST(DetectConfig, NeighbourhoodsReachTheNextVoxelsAndNotThousands) {
  DetectConfig config;
  for (const auto& [ratio, valid] : {std::pair{1.4f, false}, {1.6f, true}, {7.9f, true}, {8.1f, false}}) {
    config.neighborhoods.radius_m = ratio * config.downsample.leaf_size_m;
    EXPECT_EQ(!config.validate(), valid) << ratio;
  }
  EXPECT_EQ(config.validate()->key, "neighborhoods.radius_m");
}

}  // namespace
}  // namespace graspd
