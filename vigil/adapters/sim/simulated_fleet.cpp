#include "vigil/adapters/sim/simulated_fleet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vigil::sim {
namespace {

/// What a drone's random stream is for.
enum Purpose : std::uint64_t { kTrackerPurpose = 1 };

}  // namespace

SimulatedFleet::SimulatedFleet(const FleetParameters& parameters, std::span<const Vec2> starts)
    : truth_(starts.size()),
      delay_ticks_(static_cast<std::size_t>(std::lround(parameters.vehicle.command_delay_s / parameters.dt_s))) {
  vehicles_.reserve(starts.size());
  trackers_.reserve(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    vehicles_.emplace_back(parameters.vehicle, starts[i], parameters.starts_flying);
    trackers_.emplace_back(parameters.tracker, parameters.dt_s,
                           dynamics::RandomStream(parameters.seed, i, kTrackerPurpose));
  }
  orders_.resize(starts.size() * (delay_ticks_ + 1));
  copy_truth();
}

void SimulatedFleet::copy_truth() noexcept {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) truth_[i] = vehicles_[i].truth();
}

void SimulatedFleet::observe(runtime::MissionTime, std::span<swarm::DroneObservation> out) noexcept {
  assert(out.size() == size());
  for (std::size_t i = 0; i < size(); ++i) {
    trackers_[i].measure(truth_[i]);
    trackers_[i].observe(out[i]);
    out[i].mode = truth_[i].mode;
    out[i].link_age_s = 0.0;
  }
}

void SimulatedFleet::order(runtime::MissionTime, std::span<const swarm::DroneOrder> orders) noexcept {
  assert(orders.size() == size());
  newest_ = (newest_ + 1) % (delay_ticks_ + 1);
  std::copy(orders.begin(), orders.end(), orders_.begin() + static_cast<std::ptrdiff_t>(newest_ * size()));
  deliver_orders();
}

void SimulatedFleet::deliver_orders() noexcept {
  const std::size_t oldest = (newest_ + 1) % (delay_ticks_ + 1);
  for (std::size_t i = 0; i < size(); ++i) vehicles_[i].obey(orders_[oldest * size() + i]);
}

void SimulatedFleet::advance(double dt_s) noexcept {
  for (SimulatedVehicle& vehicle : vehicles_) vehicle.advance(dt_s);
  copy_truth();
}

void SimulatedFleet::fail(swarm::DroneId drone) noexcept { vehicles_[drone.index()].fail(); }

void SimulatedFleet::take_over(swarm::DroneId drone, const Vec2& velocity) noexcept {
  vehicles_[drone.index()].take_over(velocity);
}

void SimulatedFleet::give_back(swarm::DroneId drone) noexcept { vehicles_[drone.index()].give_back(); }

void SimulatedFleet::hide(swarm::DroneId drone, double for_s) noexcept { trackers_[drone.index()].hide(for_s); }

}  // namespace vigil::sim
