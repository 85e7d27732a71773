#include "vigil/adapters/sim/simulated_link.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::sim {
namespace {

std::size_t ticks_of(double delay_s, double dt_s) { return static_cast<std::size_t>(std::lround(delay_s / dt_s)); }

}  // namespace

SimulatedLink::SimulatedLink(const LinkParameters& parameters, double dt_s, dynamics::RandomStream random)
    : packets_(parameters.packets),
      beat_(parameters.packets_per_tick),
      dt_s_(dt_s),
      longest_ticks_(ticks_of(packets_.delay_s + packets_.jitter_s, dt_s)),
      is_certain_(packets_.p_close <= 0.0 && packets_.jitter_s <= 0.0),
      random_(random) {}

void SimulatedLink::cut(double for_s) noexcept { cut_s_ = std::max(cut_s_, for_s); }

dynamics::PacketFate SimulatedLink::draw() noexcept {
  const double transition = random_.uniform();
  return dynamics::send(packets_, state_, {.transition = transition, .jitter = random_.uniform()});
}

std::optional<std::size_t> SimulatedLink::send() noexcept {
  const bool is_cut = cut_s_ > 0.0;
  cut_s_ = std::max(0.0, cut_s_ - dt_s_);
  if (!beat_.next()) return std::nullopt;
  if (is_certain_) return is_cut ? std::nullopt : std::optional(longest_ticks_);
  const dynamics::PacketFate fate = draw();
  state_ = fate.link;
  if (is_cut || !fate.is_delivered) return std::nullopt;
  return ticks_of(fate.delay_s, dt_s_);
}

}  // namespace vigil::sim
