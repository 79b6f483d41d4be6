// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A token of the user's own for a web server, in the same way for all programs.
#pragma once
#include <cstddef>
#include <string>

namespace CLI {
class App;
}

namespace graspd {

inline constexpr std::size_t kShortestToken = 16;

/// Where the user has put it.
struct TokenPlaces {
  std::string file;         ///< its first line; empty: none
  const char* environment;  ///< name of a variable that counts where there is no file
};

/// Adds --token-file.
void add_token_file(CLI::App& app, TokenPlaces& places);

/// Empty where none is given: the server draws one. Throws std::runtime_error that names the place for a file
/// that cannot be read, and for a token of less than kShortestToken characters or with any but visible ASCII
/// ones. Before there are threads, because of the environment.
[[nodiscard]] std::string given_token(const TokenPlaces& places);

}  // namespace graspd
