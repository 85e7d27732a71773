#pragma once

#include <optional>

#include "vigil/adapters/sim/beat.hpp"
#include "vigil/adapters/sim/in_transit.hpp"
#include "vigil/core/dynamics/packet_link.hpp"
#include "vigil/core/dynamics/random_stream.hpp"

namespace vigil::sim {

/// One direction of the radio between the ground and a vehicle.
struct LinkParameters {
  dynamics::PacketLink packets;
  double packets_per_tick = 1.0;  ///< 1 or more: every tick has one
};

/// Draws what becomes of each packet of one direction. Delays are rounded to whole ticks, each packet's whole delay at
/// once.
class SimulatedLink {
 public:
  SimulatedLink(const LinkParameters& parameters, double dt_s, dynamics::RandomStream random);

  /// One tick: in how many ticks a packet arrives that is handed over now. None where it is lost, or where no packet is
  /// due in this tick.
  [[nodiscard]] std::optional<std::size_t> send() noexcept;
  /// Whatever is sent within so long from now on is lost.
  void cut(double for_s) noexcept;
  [[nodiscard]] std::size_t longest_ticks() const noexcept { return longest_ticks_; }

 private:
  [[nodiscard]] dynamics::PacketFate draw() noexcept;

  dynamics::PacketLink packets_;
  dynamics::PacketLinkState state_;
  Beat beat_;
  double dt_s_;
  std::size_t longest_ticks_;
  bool is_certain_;  ///< no packet is lost by itself, and each takes as long
  double cut_s_ = 0.0;
  dynamics::RandomStream random_;
};

/// A link with the packets that are on their way.
template <typename Packet>
class Channel {
 public:
  Channel(const LinkParameters& parameters, double dt_s, dynamics::RandomStream random)
      : link_(parameters, dt_s, random), in_transit_(link_.longest_ticks()) {}

  /// One tick: offers the newest packet, and gives what arrives in this tick; null where nothing does.
  [[nodiscard]] const Packet* pass(const Packet& offered) noexcept {
    if (const std::optional<std::size_t> ticks = link_.send()) in_transit_.send(offered, *ticks);
    return in_transit_.receive();
  }
  void cut(double for_s) noexcept { link_.cut(for_s); }

 private:
  SimulatedLink link_;
  InTransit<Packet> in_transit_;
};

}  // namespace vigil::sim
