#pragma once

#include <vector>

#include "vigil/adapters/sim/simulated_tracker.hpp"
#include "vigil/adapters/sim/simulated_vehicle.hpp"
#include "vigil/runtime/fleet.hpp"

namespace vigil::sim {

struct FleetParameters {
  VehicleParameters vehicle;
  TrackerParameters tracker;
  double dt_s = 0.02;  ///< of the control tick
  std::uint64_t seed = 1;
  bool starts_flying = true;
};

/// Simulated vehicles behind the Fleet port. A tick is observe(), order(), advance(dt_s). Allocates nothing after its
/// construction. One thread at a time; the same seed gives the same bits.
class SimulatedFleet : public runtime::VirtualFleet {
 public:
  SimulatedFleet(const FleetParameters& parameters, std::span<const Vec2> starts);

  [[nodiscard]] std::size_t size() const noexcept override { return vehicles_.size(); }
  void observe(runtime::MissionTime now, std::span<swarm::DroneObservation> out) noexcept override;
  void order(runtime::MissionTime now, std::span<const swarm::DroneOrder> orders) noexcept override;
  void advance(double dt_s) noexcept override;
  [[nodiscard]] std::span<const runtime::TruthSample> truth() const noexcept override { return truth_; }
  void fail(swarm::DroneId drone) noexcept override;
  void take_over(swarm::DroneId drone, const Vec2& velocity) noexcept override;
  void give_back(swarm::DroneId drone) noexcept override;
  void hide(swarm::DroneId drone, double for_s) noexcept override;

 private:
  void deliver_orders() noexcept;
  void copy_truth() noexcept;

  std::vector<SimulatedVehicle> vehicles_;
  std::vector<SimulatedTracker> trackers_;
  std::vector<runtime::TruthSample> truth_;
  /// Orders on their way, one row of size() per tick of delay and one for those that arrive now.
  std::vector<swarm::DroneOrder> orders_;
  std::size_t delay_ticks_;
  std::size_t newest_ = 0;
};

}  // namespace vigil::sim
