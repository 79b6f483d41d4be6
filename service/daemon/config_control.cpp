// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/daemon/config_control.hpp"

#include <utility>

namespace graspd {

ConfigControl::Proposal ConfigControl::propose_reload() const {
  return {load_(overrides_), overrides_, undos_};
}

ConfigControl::Proposal ConfigControl::propose(const control_t& control) const {
  if (control.command == control_t::RELOAD) return propose_reload();
  std::vector<std::string> undos = undos_;
  std::string overrides;
  if (control.command == control_t::UNDO) {
    if (undos.empty()) throw ConfigError("nothing to undo");
    overrides = std::move(undos.back());
    undos.pop_back();
  } else {
    if (control.command == control_t::SET) overrides = merge_overrides(overrides_, control.text);
    if (undos.size() == kMostUndos) undos.erase(undos.begin());
    undos.push_back(overrides_);
  }
  ServiceConfig config = load_(overrides);
  return {std::move(config), std::move(overrides), std::move(undos)};
}

void ConfigControl::accept(Proposal proposal) {
  overrides_ = std::move(proposal.overrides);
  undos_ = std::move(proposal.undos);
  error_.clear();
  ++revision_;
}

}  // namespace graspd
