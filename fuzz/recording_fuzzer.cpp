// What is in a recording's messages, whatever bytes they have: read, or refused with a reason. What was read as the
// beginning of a flight is one that the controller can be set up with.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "vigil/adapters/recording/own_messages.hpp"
#include "vigil/adapters/recording/recording_error.hpp"

namespace {

using namespace vigil;

void require(bool holds) {
  if (!holds) std::abort();
}

template <class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const recording::RecordingError& error) {
    require(error.what()[0] != '\0');
  }
}

/// A copy with the seal that belongs to it, so that what is behind seals is reached.
std::vector<char> sealed(std::span<const char> bytes) {
  constexpr std::size_t kEncapsulation = 4;
  constexpr std::size_t kSeal = 8;
  const bool is_long = bytes.size() > kEncapsulation + kSeal;
  const auto body = is_long ? bytes.subspan(kEncapsulation, bytes.size() - kEncapsulation - kSeal) : bytes;
  recording::CdrWriter writer;
  writer.start(body.size() + kSeal);
  for (const char byte : body) writer.put(static_cast<std::uint8_t>(byte));
  writer.seal();
  return {writer.message().begin(), writer.message().end()};
}

void read_all(std::span<const char> message) {
  read_or_refuse([&] {
    const runtime::RecordingHead head = recording::read_head(message);
    require(head.parameters.drones >= 1 && head.parameters.dt_s > 0.0);
  });
  read_or_refuse([&] { (void)recording::read_commands(message); });
  read_or_refuse([&] { (void)recording::read_targets(message); });
  read_or_refuse([&] { (void)recording::read_event(message); });
  runtime::RecordedTick tick(3);
  read_or_refuse([&] {
    recording::read_tick(message, tick);
    require(tick.observations.size() == 3 && (tick.truth.empty() || tick.truth.size() == 3));
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const char> bytes(reinterpret_cast<const char*>(data), size);
  read_all(bytes);
  read_all(sealed(bytes));
  return 0;
}
