// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
#include "service/transport/seal_keys.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include "service/transport/file_descriptor.hpp"

namespace graspd {
namespace {

constexpr std::size_t kMaxFileBytes = 16384;
constexpr std::size_t kMaxKeys = 16;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error("key file '" + file.string() + "': " + reason);
}

void require_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium finds no source of random numbers");
}

/// Of the open file, so that nobody can change it in between.
void check_access(const std::filesystem::path& file, int fd) {
  struct stat status {};
  if (fstat(fd, &status) != 0) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail(file, "not a regular file");
  constexpr mode_t kNotForOthers = S_IRWXO | S_IWGRP;
  if ((status.st_mode & kNotForOthers) != 0)
    fail(file, "others may read or change it; remedy: chmod 600 '" + file.string() + "'");
}

std::string read_text(const std::filesystem::path& file) {
  // A pipe would block for ever.
  const FileDescriptor fd(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (fd.get() < 0) fail(file, std::string("cannot be read: ") + std::strerror(errno));
  check_access(file, fd.get());
  std::string text(kMaxFileBytes + 1, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const ssize_t got = read(fd.get(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(file, std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  if (size > kMaxFileBytes) fail(file, "too large for keys");
  text.resize(size);
  return text;
}

std::string_view trimmed(std::string_view line) {
  line = line.substr(0, std::min(line.find('#'), line.size()));
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == line.npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

bool parse_key(std::string_view digits, SealKey& key) {
  std::size_t size = 0;
  return digits.size() == 2 * kSealKeyBytes &&
         sodium_hex2bin(key.bytes.data(), key.bytes.size(), digits.data(), digits.size(), nullptr, &size,
                        nullptr) == 0 &&
         size == kSealKeyBytes;
}

}  // namespace

std::vector<SealKey> parse_seal_keys(std::string_view text) {
  std::vector<SealKey> keys;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    SealKey key;
    // Without what is there: it may be most of a key.
    if (!parse_key(line, key))
      throw std::runtime_error("line " + std::to_string(number) +
                               ": not a key (expected 64 hexadecimal digits)");
    if (keys.size() == kMaxKeys) throw std::runtime_error("more than " + std::to_string(kMaxKeys) + " keys");
    keys.push_back(key);
  }
  if (keys.empty()) throw std::runtime_error("no key in it");
  return keys;
}

std::vector<SealKey> load_seal_keys(const std::filesystem::path& file) {
  require_sodium();  // chooses its fastest code for this processor, too
  const std::string text = read_text(file);
  try {
    return parse_seal_keys(text);
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
}

void create_seal_key(const std::filesystem::path& file) {
  require_sodium();
  SealKey key;
  randombytes_buf(key.bytes.data(), key.bytes.size());
  std::string text(2 * kSealKeyBytes + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), key.bytes.data(), key.bytes.size());
  text.back() = '\n';
  const FileDescriptor fd(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (fd.get() < 0) fail(file, std::string("cannot be created: ") + std::strerror(errno));
  if (write(fd.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) || fsync(fd.get()) != 0)
    fail(file, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace graspd
