// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// A set of bins of a profile, one bit each, so that gaps are found many bins at a time.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace graspd {

class BinSet {
 public:
  static constexpr int kMostBins = 2048;
  static constexpr int kWordBins = 64;

  /// Bytes are 0 or 1, one for each of size() bins. Their number is a multiple of kWordBins, at most
  /// kMostBins.
  explicit BinSet(std::span<const std::uint8_t> bytes) : num_words_(bytes.size() / kWordBins) {
    for (std::size_t w = 0; w < num_words_; ++w) words_[w] = pack(bytes.data() + w * kWordBins);
  }

  [[nodiscard]] int size() const { return static_cast<int>(num_words_) * kWordBins; }
  [[nodiscard]] bool has(int bin) const {
    return bin >= 0 && bin < size() && ((words_[index(bin)] >> (bin % kWordBins)) & 1) != 0;
  }

  friend BinSet operator|(BinSet a, const BinSet& b) {
    for (std::size_t w = 0; w < a.num_words_; ++w) a.words_[w] |= b.words_[w];
    return a;
  }

  /// First one at or after a bin; size() where there is none.
  [[nodiscard]] int next(int bin) const {
    if (bin < 0) bin = 0;
    if (bin >= size()) return size();
    std::size_t w = index(bin);
    std::uint64_t word = words_[w] & (~std::uint64_t{0} << (bin % kWordBins));
    while (word == 0)
      if (++w == num_words_)
        return size();
      else
        word = words_[w];
    return static_cast<int>(w) * kWordBins + std::countr_zero(word);
  }
  /// Last one at or before a bin; -1 where there is none.
  [[nodiscard]] int previous(int bin) const {
    if (bin >= size()) bin = size() - 1;
    if (bin < 0) return -1;
    std::size_t w = index(bin);
    std::uint64_t word = words_[w] & (~std::uint64_t{0} >> (kWordBins - 1 - bin % kWordBins));
    while (word == 0)
      if (w-- == 0)
        return -1;
      else
        word = words_[w];
    return static_cast<int>(w) * kWordBins + (kWordBins - 1) - std::countl_zero(word);
  }

  /// Number of those in [first, last].
  [[nodiscard]] int count(int first, int last) const {
    int n = 0;
    for (int bin = next(first); bin <= last && bin < size(); bin = next(bin + 1)) ++n;
    return n;
  }

  /// The bins at which so many or more that are not in the set begin, those beyond the last counted among
  /// them.
  [[nodiscard]] BinSet gaps(int length) const {
    BinSet run(*this);
    for (std::size_t w = 0; w < num_words_; ++w) run.words_[w] = ~words_[w];
    // Runs of as many bins as are known, from two that overlap.
    for (int known = 1; known < length;) {
      const int more = known <= length - known ? known : length - known;
      run.keep_where_also_after(more);
      known += more;
    }
    return run;
  }

 private:
  [[nodiscard]] static std::size_t index(int bin) { return static_cast<std::size_t>(bin) / kWordBins; }

  [[nodiscard]] static std::uint64_t pack(const std::uint8_t* bytes) {
    std::uint64_t word = 0;
    for (unsigned k = 0; k < 8; ++k) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, bytes + 8 * k, sizeof eight);
      if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
      // Takes bit 0 of each byte to its place in the highest byte.
      word |= (eight * 0x0102040810204080u >> 56) << (8 * k);
    }
    return word;
  }

  /// Keeps a bin where the one so far after it is there too; beyond the last bin all are.
  void keep_where_also_after(int far) {
    const std::size_t words = index(far);
    const int bits = far % kWordBins;
    const auto at = [this](std::size_t w) { return w < num_words_ ? words_[w] : ~std::uint64_t{0}; };
    for (std::size_t w = 0; w < num_words_; ++w) {
      const std::uint64_t low = at(w + words), high = at(w + words + 1);
      words_[w] &= bits == 0 ? low : low >> bits | high << (kWordBins - bits);
    }
  }

  std::array<std::uint64_t, kMostBins / kWordBins> words_;
  std::size_t num_words_;
};

}  // namespace graspd
