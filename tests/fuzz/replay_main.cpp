// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzzer over the files of folders, each also cut short and with single bytes changed, at no more than
// kMaxPlaces places of a file.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "tests/fuzz/fuzzer.hpp"

namespace {

constexpr std::size_t kMaxPlaces = 160;

void replay(std::vector<std::uint8_t> bytes) {
  const std::size_t stride = std::max<std::size_t>(1, bytes.size() / kMaxPlaces);
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  for (std::size_t size = 0; size < bytes.size(); size += stride) {
    const std::vector<std::uint8_t> part(bytes.data(),
                                         bytes.data() + size);  // the end of memory is the end of the part
    LLVMFuzzerTestOneInput(part.data(), part.size());
  }
  for (std::size_t i = 0; i < bytes.size(); i += stride) {
    const std::uint8_t original = bytes[i];
    for (const int change : {0x01, 0x80, 0xff}) {
      bytes[i] = static_cast<std::uint8_t>(original ^ change);
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    bytes[i] = original;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t count = 0;
  for (int i = 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      std::ifstream file(entry.path(), std::ios::binary);
      replay({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
      ++count;
    }
  }
  std::cout << count << " files replayed\n";
  return count > 0 ? 0 : 1;  // an empty corpus tests nothing
}
