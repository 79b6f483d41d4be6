// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/config_control.hpp"

#include <gtest/gtest.h>

#include "service/transport/message_parts.hpp"

namespace graspd {
namespace {

static_assert(kMaxOverridesBytes == static_cast<std::size_t>(kMaxOverridesLength),
              "what may be SET fits into a status");

control_t control(std::int8_t command, const std::string& text = "") {
  return {0, 1, command, text};
}

class ConfigControlTest : public testing::Test {
 protected:
  /// The number of workers after a command; the error when it is refused.
  std::string send(const control_t& message) {
    try {
      ConfigControl::Proposal proposal = control_.propose(message);
      const std::string workers = std::to_string(proposal.config.workers);
      control_.accept(std::move(proposal));
      return workers;
    } catch (const ConfigError& error) {
      control_.refuse(error.what());
      return error.what();
    }
  }
  std::string set(int workers) {
    return send(control(control_t::SET, "workers: " + std::to_string(workers)));
  }

  int file_workers_ = 2;
  ConfigControl control_{[this](const std::string& overrides) {
    ConfigLayers layers;
    layers.workers = file_workers_;
    layers.overrides = overrides;
    return load_layers(layers);
  }};
};

TEST_F(ConfigControlTest, SetsUndoesAndResets) {
  EXPECT_EQ(set(3), "3");
  EXPECT_EQ(set(4), "4");
  EXPECT_EQ(send(control(control_t::UNDO)), "3");
  EXPECT_EQ(set(5), "5");
  EXPECT_EQ(send(control(control_t::RESET)), "2");
  EXPECT_EQ(control_.overrides(), "");
  EXPECT_EQ(send(control(control_t::UNDO)), "5") << "a reset can be taken back";
  EXPECT_EQ(control_.revision(), 7);
}

TEST_F(ConfigControlTest, AReloadKeepsWhatWasSet) {
  EXPECT_EQ(send(control(control_t::SET, "threads: 7")), "2");
  file_workers_ = 9;
  EXPECT_EQ(send(control(control_t::RELOAD)), "9");
  EXPECT_EQ(control_.propose_reload().config.threads, 7);
  EXPECT_EQ(send(control(control_t::UNDO)), "9");
}

TEST_F(ConfigControlTest, WhatIsRefusedChangesNothing) {
  EXPECT_EQ(set(3), "3");
  const std::string overrides = control_.overrides();
  for (const char* bad : {"workers: 0", "nonsense: 1", "{", "[]", "sources: [{name: x}]"}) {
    EXPECT_NE(send(control(control_t::SET, bad)), "3") << bad;
    EXPECT_FALSE(control_.error().empty());
    EXPECT_EQ(control_.overrides(), overrides);
    EXPECT_EQ(control_.revision(), 2);
  }
  EXPECT_EQ(send(control(control_t::UNDO)), "2");
  EXPECT_EQ(control_.error(), "") << "the newest was taken";
  EXPECT_EQ(send(control(control_t::UNDO)), "nothing to undo");
}

TEST_F(ConfigControlTest, AReasonIsNeverLongerThanAStatusHolds) {
  control_.refuse(std::string(5000, 'x'));
  EXPECT_EQ(control_.error().size(), ConfigControl::kLongestError);
}

TEST_F(ConfigControlTest, KeepsABoundedNumberOfSteps) {
  const int steps = static_cast<int>(ConfigControl::kMostUndos) + 10;
  for (int i = 1; i <= steps; ++i) EXPECT_EQ(set(i), std::to_string(i));
  for (int i = 1; i <= static_cast<int>(ConfigControl::kMostUndos); ++i)
    EXPECT_EQ(send(control(control_t::UNDO)), std::to_string(steps - i));
  EXPECT_EQ(send(control(control_t::UNDO)), "nothing to undo");
}

}  // namespace
}  // namespace graspd
