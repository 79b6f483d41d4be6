// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/hub.hpp"

#include <stdexcept>
#include <utility>

namespace graspd {
namespace {

AccessRules make_rules(const WebConfig& config) {
  const bool local = is_loopback(config.address);
  if (!local && config.token.empty())
    throw std::runtime_error(config.address + ": who listens beyond this machine must give a token");
  return {local, config.token.empty() ? draw_token() : config.token, config.origins};
}

}  // namespace

WebHub::WebHub(WebConfig config_in, WebHandlers handlers_in)
    : config(std::move(config_in)),
      handlers(std::move(handlers_in)),
      rules(make_rules(config)),
      assets(config.assets) {}

void WebHub::add(std::int64_t id, const std::shared_ptr<WebPeer>& peer) {
  const std::scoped_lock lock(mutex_);
  peers_[id] = peer;
}

void WebHub::remove(std::int64_t id) {
  const std::scoped_lock lock(mutex_);
  peers_.erase(id);
}

void WebHub::clear() {
  std::map<std::int64_t, std::shared_ptr<WebPeer>> peers;  // outlives the lock
  const std::scoped_lock lock(mutex_);
  peers.swap(peers_);
}

void WebHub::for_each(const std::function<void(WebPeer&)>& action) {
  const std::scoped_lock lock(mutex_);
  for (const auto& [id, peer] : peers_) action(*peer);
}

void WebHub::with(std::int64_t id, const std::function<void(WebPeer&)>& action) {
  const std::scoped_lock lock(mutex_);
  if (const auto found = peers_.find(id); found != peers_.end()) action(*found->second);
}

int WebHub::size() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<int>(peers_.size());
}

}  // namespace graspd
