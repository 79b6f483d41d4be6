// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/web/web_token.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "client/common/read_file.hpp"
#include "client/common/text.hpp"

namespace graspd {
namespace {

std::string checked(std::string token, const std::string& place) {
  // Addresses and headers carry nothing else.
  if (std::any_of(token.begin(), token.end(), [](char c) { return c < 0x20 || c >= 0x7f; }))
    throw std::runtime_error(place + ": the token has other characters than visible ASCII ones and spaces");
  if (token.size() < kShortestToken)
    throw std::runtime_error(place + printed(": the token is shorter than %zu characters", kShortestToken));
  return token;
}

}  // namespace

void add_token_file(CLI::App& app, TokenPlaces& places) {
  app.add_option(
      "--token-file", places.file,
      printed("whose first line, %zu characters at least, is the token that a client needs to change "
              "anything (default: the environment variable %s, else a new one each start)",
              kShortestToken, places.environment));
}

std::string given_token(const TokenPlaces& places) {
  if (!places.file.empty()) {
    std::string line = read_file(places.file);
    line.resize(std::min(line.find('\n'), line.size()));
    if (line.ends_with('\r')) line.pop_back();
    return checked(std::move(line), places.file);
  }
  const char* token = std::getenv(places.environment);  // NOLINT(concurrency-mt-unsafe): before any thread
  return token != nullptr ? checked(token, places.environment) : "";
}

}  // namespace graspd
