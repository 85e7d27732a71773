#include "vigil/adapters/recording/cdr_reader.hpp"

#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"

namespace vigil::recording {

using eprosima::fastcdr::Cdr;

// Fast-CDR takes bytes to read from as it takes bytes to write to; it does not change them.
CdrReader::CdrReader(std::span<const char> bytes)
    : size_(bytes.size()),
      buffer_(const_cast<char*>(bytes.data()), bytes.size()),
      cdr_(buffer_, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR) {
  constexpr std::size_t kEncapsulation = 4;
  if (size_ < kEncapsulation) refuse("ends early");
  guarded([this] { cdr_.read_encapsulation(); });
  if (cdr_.endianness() != Cdr::LITTLE_ENDIANNESS) refuse("is not little-endian");
}

std::string CdrReader::text() {
  std::string text(count(1), '\0');
  elements(std::span<char>(text));
  if (text.empty() || text.back() != '\0') refuse("holds a text without its end");
  text.pop_back();
  return text;
}

std::size_t CdrReader::count(std::size_t element_bytes) {
  const std::size_t elements = u32();
  if (elements > left() / element_bytes) refuse("is shorter than it says");
  return elements;
}

void CdrReader::refuse(const char* what) { throw RecordingError(fmt::format("a message {}", what)); }

}  // namespace vigil::recording
