#include "vigil/adapters/recording/cdr_writer.hpp"

#include <algorithm>
#include <cstring>

#include "vigil/adapters/recording/seal.hpp"

namespace vigil::recording {

using eprosima::fastcdr::Cdr;

namespace {

constexpr std::size_t kEncapsulation = 4;
constexpr std::size_t kSurplus = kEncapsulation + 16;  // and for a seal

}  // namespace

void CdrWriter::start(std::size_t most_bytes) {
  const std::size_t used = cdr_ ? cdr_->getSerializedDataLength() : 0;
  cdr_.reset();
  std::fill_n(bytes_.begin(), used, '\0');
  if (bytes_.size() < most_bytes + kSurplus) bytes_.assign(most_bytes + kSurplus, '\0');
  buffer_ = eprosima::fastcdr::FastBuffer(bytes_.data(), bytes_.size());
  cdr_.emplace(buffer_, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr_->serialize_encapsulation();
}

void CdrWriter::put(std::string_view text) {
  put(static_cast<std::uint32_t>(text.size() + 1));
  if (!text.empty()) cdr_->serializeArray(text.data(), text.size());
  cdr_->serialize('\0');
}

void CdrWriter::seal() {
  constexpr std::size_t kWord = 8;
  const std::size_t body = (message().size() - kEncapsulation + kWord - 1) / kWord * kWord;
  put(seal_of({bytes_.data(), kEncapsulation + body}));  // with the zeros that align the seal
}

bool is_sealed(std::span<const char> message) {
  std::uint64_t seal = 0;
  if (message.size() < kEncapsulation + sizeof(seal)) return false;
  std::memcpy(&seal, message.data() + message.size() - sizeof(seal), sizeof(seal));
  return seal == seal_of(message.first(message.size() - sizeof(seal)));
}

std::span<const char> CdrWriter::message() const { return {bytes_.data(), cdr_->getSerializedDataLength()}; }

}  // namespace vigil::recording
