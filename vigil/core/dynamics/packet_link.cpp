#include "vigil/core/dynamics/packet_link.hpp"

namespace vigil::dynamics {

PacketLink bursty_link(double mean_loss, double mean_burst_packets, double delay_s, double jitter_s) noexcept {
  const double p_open = 1.0 / mean_burst_packets;
  return {
      .p_close = p_open * mean_loss / (1.0 - mean_loss), .p_open = p_open, .delay_s = delay_s, .jitter_s = jitter_s};
}

PacketFate send(const PacketLink& link, const PacketLinkState& state, const PacketDraws& draws) noexcept {
  const bool changes = draws.transition < (state.is_closed ? link.p_open : link.p_close);
  const bool is_closed = state.is_closed != changes;
  return {{is_closed}, !is_closed, link.delay_s + link.jitter_s * draws.jitter};
}

}  // namespace vigil::dynamics
