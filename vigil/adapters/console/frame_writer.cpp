#include "vigil/adapters/console/frame_writer.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace vigil::console {

FrameWriter::FrameWriter(Kind kind, std::uint8_t flags, std::uint16_t header_bytes, std::uint32_t epoch,
                         std::uint32_t count)
    : bytes_("VGL1") {
  assert(header_bytes % 4 == 0 && header_bytes >= 16);
  put(static_cast<std::uint8_t>(kind));
  put(flags);
  put(header_bytes);
  put(epoch);
  put(count);
}

void FrameWriter::append(unsigned char* bytes, std::size_t size) {
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + size);
  for (std::size_t i = 0; i < size; ++i) bytes_.push_back(static_cast<char>(bytes[i]));
}

void FrameWriter::align() {
  while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
}

}  // namespace vigil::console
