#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace vigil::console {

/// Writes a binary frame of protocol/README.md: little-endian, packed, arrays from multiples of 4 bytes on.
class FrameWriter {
 public:
  enum class Kind : std::uint8_t {
    kSnapshot = 1,
    kDensity = 2,
    kCoverage = 3,
    kAge = 4,
    kTrails = 5,
    kHistory = 6,
    kPart = 7
  };

  /// Precondition: header_bytes is a multiple of 4, at least 16.
  FrameWriter(Kind kind, std::uint8_t flags, std::uint16_t header_bytes, std::uint32_t epoch, std::uint32_t count);

  /// The next number: of the header, then of the arrays.
  template <typename Number>
  void put(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    unsigned char bytes[sizeof(Number)];
    std::memcpy(bytes, &value, sizeof(Number));
    append(bytes, sizeof(Number));
  }
  void put_bytes(std::string_view bytes) { bytes_.append(bytes); }
  /// Zero bytes up to the next multiple of 4: before every array.
  void align();
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void append(unsigned char* bytes, std::size_t size);

  std::string bytes_;
};

}  // namespace vigil::console
