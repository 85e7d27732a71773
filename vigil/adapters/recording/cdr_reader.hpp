#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

namespace vigil::recording {

/// Reads one CDR message. Whatever its bytes, it never reads beyond them and never allocates for what they only claim:
/// RecordingError where they end early or say what cannot be.
class CdrReader {
 public:
  /// The bytes outlive this.
  explicit CdrReader(std::span<const char> bytes);

  [[nodiscard]] double number() { return get<double>(); }
  [[nodiscard]] std::uint64_t u64() { return get<std::uint64_t>(); }
  [[nodiscard]] std::uint32_t u32() { return get<std::uint32_t>(); }
  [[nodiscard]] std::int32_t i32() { return get<std::int32_t>(); }
  [[nodiscard]] std::uint8_t u8() { return get<std::uint8_t>(); }
  [[nodiscard]] bool flag() { return get<bool>(); }
  [[nodiscard]] std::string text();

  /// A sequence's length; refused where its elements, of at least `element_bytes` each, cannot be there.
  [[nodiscard]] std::size_t count(std::size_t element_bytes);
  /// A sequence that must have as many elements as `out`.
  template <class Number>
  void sequence(std::span<Number> out) {
    if (count(sizeof(Number)) != out.size()) refuse("a sequence of another length than its message has");
    elements(out);
  }
  /// A sequence of any length.
  template <class Number>
  [[nodiscard]] std::vector<Number> sequence() {
    std::vector<Number> out(count(sizeof(Number)));
    elements(std::span<Number>(out));
    return out;
  }
  /// Elements without a length.
  template <class Number>
  void elements(std::span<Number> out) {
    if (out.empty()) return;
    guarded([&] { cdr_.deserializeArray(out.data(), out.size()); });
  }

 private:
  template <class Value>
  Value get() {
    Value value{};
    guarded([&] { cdr_.deserialize(value); });
    return value;
  }
  template <class Read>
  void guarded(const Read& read) {
    try {
      read();
    } catch (const eprosima::fastcdr::exception::Exception&) {
      refuse("ends early, or holds what cannot be");
    }
  }
  [[noreturn]] static void refuse(const char* what);
  [[nodiscard]] std::size_t left() const { return size_ - cdr_.getSerializedDataLength(); }

  std::size_t size_;
  eprosima::fastcdr::FastBuffer buffer_;
  eprosima::fastcdr::Cdr cdr_;
};

}  // namespace vigil::recording
