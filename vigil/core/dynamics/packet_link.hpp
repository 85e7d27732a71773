#pragma once

namespace vigil::dynamics {

/// A packet link that loses packets in bursts (Gilbert and Elliott's chain of two states) and delays the others.
/// Between two packets:  open --p_close--> closed,  closed --p_open--> open.  Closed, every packet is lost. So the mean
/// loss is p_close / (p_close + p_open) and the mean burst 1 / p_open packets.
struct PacketLink {
  double p_close = 0.0;   ///< in [0, 1]
  double p_open = 1.0;    ///< in (0, 1]
  double delay_s = 0.0;   ///< >= 0, at least
  double jitter_s = 0.0;  ///< >= 0, on top: uniform between 0 and this
};

/// A link by what one measures. Precondition: 0 <= mean_loss < 1, mean_burst_packets >= 1, and a burst not so short
/// that the loss cannot be reached: mean_burst_packets >= mean_loss / (1 - mean_loss).
[[nodiscard]] PacketLink bursty_link(double mean_loss, double mean_burst_packets, double delay_s,
                                     double jitter_s) noexcept;

struct PacketLinkState {
  bool is_closed = false;
};

/// Independent draws, uniform in [0, 1).
struct PacketDraws {
  double transition = 0.0;
  double jitter = 0.0;
};

struct PacketFate {
  PacketLinkState link;  ///< for the next packet
  bool is_delivered = false;
  double delay_s = 0.0;  ///< from sending to arrival; meaningless for a lost one
};

/// What becomes of the next packet. Packets may overtake each other where they follow sooner than the jitter.
[[nodiscard]] PacketFate send(const PacketLink& link, const PacketLinkState& state, const PacketDraws& draws) noexcept;

}  // namespace vigil::dynamics
