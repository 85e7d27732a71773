#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"
#include "vigil/adapters/ros/flight_phase.hpp"
#include "vigil/adapters/ros/mistaken_bodies.hpp"
#include "vigil/adapters/ros/position_gate.hpp"
#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"

namespace vigil::ros_bridge {

/// Crazyflies behind the Fleet port. What a drone is told in flight never pauses and never jumps because of a position:
/// a position that is not believed (PositionGate) is none, and a drone that is not seen is told to hover, and after
/// PhaseParameters::land_unseen_s to land. One that is seen farther outside of the field than its walls' distance is
/// landed. One that is taken for another (MistakenBodies) hovers at once. Height is
/// kept here; the tick knows the plane alone. The control thread's.
class RosFleet final : public runtime::Fleet {
 public:
  RosFleet(const runtime::Mission& mission, std::unique_ptr<CrazyswarmPort> port);

  [[nodiscard]] std::size_t size() const noexcept override { return drones_.size(); }
  void observe(runtime::MissionTime now, std::span<swarm::DroneObservation> out) noexcept override;
  void order(runtime::MissionTime now, std::span<const swarm::DroneOrder> orders) noexcept override;

 private:
  struct Drone {
    PositionGate gate;
    FlightPhase phase;
    double heard_s = -1.0;  ///< when Crazyswarm last listened; below 0: never
    Sighting newest = {};
    std::optional<std::size_t> told_of = std::nullopt;  ///< for whom it is taken, as operators were told last
    const char* refusal = nullptr;                      ///< why its newest position was not used; null: it was
    const char* told_refusal = nullptr;                 ///< as operators were told last
  };

  void look(double now_s) noexcept;
  void tell_of_the_mistaken() noexcept;
  void tell_of_the_refused(double now_s) noexcept;
  void observe(std::size_t index, double now_s, swarm::DroneObservation& out) noexcept;
  [[nodiscard]] bool has_left(const Drone& drone) const noexcept;
  void order(std::size_t index, double now_s, const swarm::DroneOrder& order) noexcept;
  [[nodiscard]] Setpoint setpoint(std::size_t index, double now_s, const swarm::DroneOrder& order) const noexcept;

  field::WorldFrame world_;
  Vec2 field_m_;
  double margin_m_;  ///< a drone this far outside is landed
  double altitude_m_;
  std::unique_ptr<CrazyswarmPort> port_;
  std::vector<Drone> drones_;
  std::vector<NamedBody> bodies_;
  MistakenBodies mistaken_;
};

}  // namespace vigil::ros_bridge
