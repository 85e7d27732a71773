#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vigil::sim {

/// Packets on their way, each with its own delay in ticks. One that arrives after a newer one is dropped, as a receiver
/// does that looks at sequence numbers. Allocates nothing after its construction.
///
///     Every tick: send() at most once, then receive() once.
template <typename Packet>
class InTransit {
 public:
  explicit InTransit(std::size_t longest_ticks) : arrivals_(longest_ticks + 1) {}

  /// Arrives at the receive() of so many ticks later: 0, the next one. Never later than longest_ticks.
  void send(const Packet& packet, std::size_t after_ticks) noexcept {
    const std::size_t after = std::min(after_ticks, arrivals_.size() - 1);
    arrivals_[wrapped(now_ + after)] = {packet, ++sent_};
  }

  /// The newest packet that arrives in this tick; null where none does, or only such as are older than what has been
  /// received. Valid until the next send().
  [[nodiscard]] const Packet* receive() noexcept {
    const Arrival& arrival = arrivals_[now_];
    now_ = wrapped(now_ + 1);
    if (arrival.number <= received_) return nullptr;
    received_ = arrival.number;
    return &arrival.packet;
  }

 private:
  struct Arrival {
    Packet packet{};
    std::uint64_t number = 0;  ///< of the packet, in the order of sending; 0: none
  };
  /// The place in the ring of a tick less than a round ahead; no division, since this is done for every packet.
  [[nodiscard]] std::size_t wrapped(std::size_t tick) const noexcept {
    return tick < arrivals_.size() ? tick : tick - arrivals_.size();
  }

  std::vector<Arrival> arrivals_;  ///< ring of ticks; of two packets for one tick the newer stays
  std::size_t now_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
};

}  // namespace vigil::sim
