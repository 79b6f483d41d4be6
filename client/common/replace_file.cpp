// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "client/common/replace_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace graspd {

void replace_file(const std::filesystem::path& file, std::string_view text) {
  // Beside it: a file can be renamed within its file system alone.
  const std::string beside = file.string() + ".tmp";
  const auto fail = [&](int error) {
    std::remove(beside.c_str());
    throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(error));
  };
  std::FILE* stream = std::fopen(beside.c_str(), "wb");
  if (stream == nullptr) fail(errno);
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const int write_error = errno;
  if (std::fclose(stream) != 0 || !written) fail(written ? errno : write_error);
  if (std::rename(beside.c_str(), file.c_str()) != 0) fail(errno);
}

}  // namespace graspd
