#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

namespace vigil::recording {

/// Writes one message after the other as little-endian CDR, as ROS 2 has it on the wire and in bags. Padding is zero:
/// the same values make the same bytes.
class CdrWriter {
 public:
  /// Begins a message of at most so many bytes. Writing more throws.
  void start(std::size_t most_bytes);

  void put(double value) { cdr_->serialize(value); }
  void put(float value) { cdr_->serialize(value); }
  void put(std::uint64_t value) { cdr_->serialize(value); }
  void put(std::uint32_t value) { cdr_->serialize(value); }
  void put(std::int32_t value) { cdr_->serialize(value); }
  void put(std::uint8_t value) { cdr_->serialize(value); }
  void put(std::int8_t value) { cdr_->serialize(value); }
  void put(bool value) { cdr_->serialize(value); }
  void put(std::string_view text);

  /// A sequence's length; its elements follow.
  void count(std::size_t elements) { put(static_cast<std::uint32_t>(elements)); }
  /// Elements without a length: an array, or a sequence's rest.
  template <class Number>
  void elements(std::span<const Number> values) {
    if (!values.empty()) cdr_->serializeArray(values.data(), values.size());
  }
  /// Length and elements.
  template <class Number>
  void sequence(std::span<const Number> values) {
    count(values.size());
    elements(values);
  }

  /// Ends the message with a number by which a reader knows that it is as it was written: is_sealed().
  void seal();

  /// All that was written since start(); valid until the next one.
  [[nodiscard]] std::span<const char> message() const;

 private:
  std::vector<char> bytes_;
  eprosima::fastcdr::FastBuffer buffer_;
  std::optional<eprosima::fastcdr::Cdr> cdr_;
};

/// Whether a message that ended with seal() is as it was written.
[[nodiscard]] bool is_sealed(std::span<const char> message);

}  // namespace vigil::recording
