#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace vigil::recording {

/// A number that tells whether values are as they were written. Each step is a bijection of what came before and of its
/// word, so that any change of one word always shows, and any other change but once in 2^64.
class Seal {
 public:
  void add(std::uint64_t word) noexcept { value_ = std::rotl(value_ ^ word, 29) * kOdd; }
  void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::span<const double> values) noexcept {
    for (const double value : values) add(value);
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  static constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15U;
  std::uint64_t value_ = 0x243F6A8885A308D3U;
};

/// Of bytes.
[[nodiscard]] inline std::uint64_t seal_of(std::span<const char> bytes) noexcept {
  Seal seal;
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    word = word << 8U | static_cast<unsigned char>(bytes[i]);
    if (i % 8 == 7) seal.add(word);
  }
  seal.add(word);
  seal.add(std::uint64_t{bytes.size()});
  return seal.value();
}

}  // namespace vigil::recording
