// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// How a running daemon takes another configuration.
#include <exception>
#include <utility>

#include "service/daemon/daemon.hpp"
#include "service/transport/control_codec.hpp"
#include "service/transport/segmentation_request_codec.hpp"

namespace graspd {
namespace {

// Controls are for people and their tools; whoever sends more at a time has to repeat some.
constexpr std::size_t kMostControls = 16;

std::set<std::string> subscriptions_of(const ServiceConfig& config) {
  std::set<std::string> channels;
  for (const SourceConfig& source : config.sources) channels.insert(source.channel);
  // Hearing its own status shows the bus that it carries something.
  channels.insert(config.lcm.status_channel);
  for (const std::string& channel : {config.lcm.control_channel, config.lcm.request_channel})
    if (!channel.empty()) channels.insert(channel);
  return channels;
}

/// Keeps a setting that holds from the start to the end.
template <class T>
void keep(const char* key, const T& old, T& wanted, std::string& changed) {
  if (old == wanted) return;
  if (!changed.empty()) changed += ',';
  changed += key;
  wanted = old;
}

}  // namespace

void Daemon::adopt(std::shared_ptr<const ServiceConfig> config, std::int64_t revision) {
  std::vector<SealKey> keys = Authentication::load_keys(*config);
  const std::set<std::string> wanted = subscriptions_of(*config);
  std::vector<std::string> added;
  try {
    for (const std::string& channel : wanted) {
      if (subscriptions_.contains(channel)) continue;
      bus_.subscribe(channel, [this, channel](const Packet& packet) { on_packet(channel, packet); });
      added.push_back(channel);
    }
  } catch (...) {
    for (const std::string& channel : added) bus_.unsubscribe(channel);
    throw;
  }
  for (const std::string& channel : subscriptions_)
    if (!wanted.contains(channel)) bus_.unsubscribe(channel);
  subscriptions_ = wanted;
  config_ = std::move(config);
  authentication_.configure(*config_, std::move(keys));
  for (const Job& job : table_.configure(config_, revision))
    drop(job, DropReason::kReconfigured, "the configuration has changed");
}

void Daemon::reload() {
  change_config("reload", [this] { return control_.propose_reload(); });
}

void Daemon::change_config(const std::string& cause,
                           const std::function<ConfigControl::Proposal()>& propose) {
  try {
    ConfigControl::Proposal proposal = propose();
    keep_fixed_settings(proposal.config);
    adopt(std::make_shared<const ServiceConfig>(proposal.config), control_.revision() + 1);
    control_.accept(std::move(proposal));
    log_.info("config_taken", {{"cause", cause}, {"revision", control_.revision()}});
  } catch (const std::exception& e) {
    control_.refuse(e.what());
    log_.error("config_refused", {{"cause", cause}, {"reason", e.what()}});
  }
}

void Daemon::keep_fixed_settings(ServiceConfig& config) {
  std::string changed;
  keep("workers", config_->workers, config.workers, changed);
  keep("threads", config_->threads, config.threads, changed);
  keep("lcm.url", config_->lcm.url, config.lcm.url, changed);
  keep("lcm.retry_longest_s", config_->lcm.retry_longest_s, config.lcm.retry_longest_s, changed);
  keep("lcm.give_up_s", config_->lcm.give_up_s, config.lcm.give_up_s, changed);
  keep("limits.max_log_lines", config_->limits.max_log_lines, config.limits.max_log_lines, changed);
  if (!changed.empty()) log_.warning("restart_needed", {{"keys", changed}});
}

void Daemon::on_control(const Packet& packet) {
  const auto opened = authentication_.open(packet, clock_.wall_utime());
  if (const auto* refusal = std::get_if<Refusal>(&opened)) {
    control_.refuse(refusal->text);
    log_.warning("control_refused", {{"reason", refusal->text}});
    return;
  }
  auto control = decode_control(std::get<std::span<const std::byte>>(opened));
  if (!control) {
    control_.refuse("a message on the control channel is no valid control_t");
    log_.warning("control_refused", {{"reason", control_.error()}});
  } else if (controls_.size() >= kMostControls) {
    log_.warning("control_refused", {{"id", control->id}, {"reason", "too many at a time"}});
  } else {
    // Not from within a handler: LCM cannot unsubscribe there.
    controls_.push_back(std::move(*control));
  }
}

void Daemon::on_request(const Packet& packet) {
  const auto opened = authentication_.open(packet, clock_.wall_utime());
  if (const auto* refusal = std::get_if<Refusal>(&opened)) {
    log_.warning("request_refused", {{"reason", refusal->text}});
    return;
  }
  const auto request = decode_segmentation_request(std::get<std::span<const std::byte>>(opened));
  if (!request) {
    log_.warning("request_refused", {{"reason", "no valid segmentation_request_t"}});
  } else if (!requests_.add(*request, clock_.now())) {
    log_.warning("request_refused", {{"reason", "for too many channels"}});
  }
}

void Daemon::obey_controls() {
  for (; !controls_.empty(); controls_.pop_front()) {
    const control_t& control = controls_.front();
    if (control.id == control_.control_id()) continue;  // sent twice, to be sure
    change_config("control " + std::to_string(control.id), [&] { return control_.propose(control); });
    control_.answered(control.id);
    next_status_ = clock_.now();  // whoever sent it waits for the answer
  }
}

}  // namespace graspd
