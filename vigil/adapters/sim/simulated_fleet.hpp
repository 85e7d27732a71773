#pragma once

#include <vector>

#include "vigil/adapters/sim/body_confusion.hpp"
#include "vigil/adapters/sim/simulated_link.hpp"
#include "vigil/adapters/sim/simulated_tracker.hpp"
#include "vigil/adapters/sim/simulated_vehicle.hpp"
#include "vigil/adapters/sim/simulated_wind.hpp"
#include "vigil/core/parallel/workers.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/swarm/charging_pad.hpp"

namespace vigil::sim {

struct FleetParameters {
  VehicleParameters vehicle;
  TrackerParameters tracker;
  ConfusionParameters confusion;
  LinkParameters link;  ///< of each direction of each vehicle
  dynamics::Wind wind;
  bool positions_over_link = false;  ///< the vehicle finds its own position and sends it down with the rest
  double dt_s = 0.02;                ///< of the control tick
  std::uint64_t seed = 1;
  bool starts_flying = true;
  std::vector<swarm::ChargingPad> pads;
  std::vector<bool> stays_down;  ///< of each drone: it is on the ground all the same; empty: none
};

/// Simulated vehicles behind the Fleet port. A tick is observe(), order(), advance(dt_s). Allocates nothing after its
/// construction. One thread at a time, but for the workers that it is given, who share the drones out among them; the
/// same seed gives the same bits for any number of them, and one drone's luck does not depend on how many others there
/// are, but for which bodies are confused.
///
/// Delays need not be whole ticks: an order's way is rounded at once, the whole delay from its sending to the vehicle's
/// answer to the nearest tick (of a link with jitter, the answer's dead time separately).
class SimulatedFleet : public runtime::VirtualFleet {
 public:
  /// `workers`, where there are any, outlive this.
  SimulatedFleet(const FleetParameters& parameters, std::span<const Vec2> starts, parallel::Workers* workers = nullptr);

  [[nodiscard]] std::size_t size() const noexcept override { return drones_.size(); }
  void observe(runtime::MissionTime now, std::span<swarm::DroneObservation> out) noexcept override;
  void order(runtime::MissionTime now, std::span<const swarm::DroneOrder> orders) noexcept override;
  void advance(double dt_s) noexcept override;
  [[nodiscard]] std::span<const runtime::TruthSample> truth() const noexcept override { return truth_; }
  void fail(swarm::DroneId drone) noexcept override;
  void take_over(swarm::DroneId drone, const Vec2& velocity) noexcept override;
  void give_back(swarm::DroneId drone) noexcept override;
  void hide(swarm::DroneId drone, double for_s) noexcept override;
  void cut_link(swarm::DroneId drone, double for_s) noexcept override;
  void befall(swarm::DroneId drone, const runtime::Mishap& mishap) noexcept override;
  void set_station(std::size_t station, bool charges) noexcept override;

 private:
  /// What a vehicle sends.
  struct Telemetry {
    swarm::VehicleMode mode = swarm::VehicleMode::kUnknown;
    double battery = 0.0;
    Sighting sighting;          ///< where positions come over the link
    std::uint64_t sent_at = 0;  ///< tick
  };
  /// What has been heard of a vehicle.
  struct Heard {
    Telemetry last;
    double age_s = swarm::DroneObservation::kNever;
  };
  /// A vehicle and what stands between it and the ground.
  struct Drone {
    SimulatedVehicle vehicle;
    SimulatedTracker tracker;
    SimulatedWind wind;
    Channel<swarm::DroneOrder> orders;
    Channel<Telemetry> telemetry;
    Heard heard;
  };

  [[nodiscard]] Drone make_drone(const FleetParameters& parameters, std::size_t number, const Vec2& start) const;
  void hear(Drone& drone) noexcept;
  void charge(Drone& drone, double dt_s) const noexcept;
  void report(const Drone& drone, swarm::DroneObservation& out) const noexcept;
  /// Calls body(drone, index) for every drone, part by part.
  template <typename Body>
  void for_each_drone(Body&& body) noexcept;

  double dt_s_;
  bool positions_over_link_;
  std::vector<Drone> drones_;
  std::vector<swarm::ChargingPad> pads_;
  std::vector<bool> has_failed_;  ///< of each station
  BodyConfusion confusion_;
  std::vector<runtime::TruthSample> truth_;
  std::uint64_t tick_ = 0;
  parallel::Workers* workers_;
};

}  // namespace vigil::sim
