#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "vigil/swarm/drone_id.hpp"
#include "vigil/swarm/observation.hpp"
#include "vigil/swarm/snapshot.hpp"

namespace vigil::runtime {

/// Time since the mission began.
using MissionTime = std::chrono::nanoseconds;

[[nodiscard]] inline MissionTime mission_time(double time_s) {
  return std::chrono::round<MissionTime>(std::chrono::duration<double>(time_s));
}

/// The one port to vehicles. Field frame on this side; an adapter converts. Called from the control thread only, once
/// each per tick, observe() first; neither may block, throw or wait for a vehicle.
class Fleet {
 public:
  virtual ~Fleet() = default;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;

  /// Writes the newest that is known of every drone at `now`. What was never heard of keeps age kNever and mode
  /// kUnknown; what is silent keeps its last values while its ages grow. Precondition: out.size() == size().
  virtual void observe(MissionTime now, std::span<swarm::DroneObservation> out) noexcept = 0;

  /// Passes the orders on, one per drone. An order stands until the next one; a vehicle that gets none for longer than
  /// its own timeout stops by itself. Precondition: orders.size() == size().
  virtual void order(MissionTime now, std::span<const swarm::DroneOrder> orders) noexcept = 0;
};

/// What really is, as only a simulator knows: the judge of safety, never the controller's input.
struct TruthSample {
  Vec2 position = Vec2::Zero();  ///< field frame
  Vec2 velocity = Vec2::Zero();
  double height_m = 0.0;
  swarm::VehicleMode mode = swarm::VehicleMode::kUnknown;
  double charge = std::numeric_limits<double>::quiet_NaN();  ///< share of what its battery can hold; NaN: it has none
  bool ran_empty = false;  ///< at some time its battery was empty while it was in the air
};

enum class MishapKind : std::uint8_t {
  kFreezeTracking,  ///< the tracker goes on telling its last place, with fresh stamps
  kShiftTracking,   ///< the tracker sees it `value` (m) from where it is
  kSwapTracking,    ///< the tracker takes it for `other`, and that one for it
  kSkewVelocity,    ///< its velocity is reported with `value` (m/s) added
  kIgnoreOrders,    ///< it hears, and flies on by the last velocity that it followed
  kDrift,           ///< it flies `value` (m/s) beside what it is told
  kLandByItself,    ///< it lands though nobody asked; for_s means nothing
  kTakenByPilot     ///< a pilot has it though nobody said so, and flies `value` (m/s)
};

/// Something that happens to one drone for a while. Field frame.
struct Mishap {
  MishapKind kind = MishapKind::kFreezeTracking;
  double for_s = 0.0;
  Vec2 value = Vec2::Zero();
  swarm::DroneId other{};  ///< kSwapTracking: another drone
};

/// A fleet whose time somebody else turns: simulators.
class VirtualFleet : public Fleet {
 public:
  /// Lets dt_s pass under the orders given last.
  virtual void advance(double dt_s) noexcept = 0;
  [[nodiscard]] virtual std::span<const TruthSample> truth() const noexcept = 0;

  // What happens to vehicles, whatever the controller wants. Precondition: drone.index() < size().
  virtual void fail(swarm::DroneId drone) noexcept = 0;  ///< in the air: stops where it is, follows nobody
  virtual void take_over(swarm::DroneId drone, const Vec2& velocity) noexcept = 0;  ///< a pilot flies it so
  virtual void give_back(swarm::DroneId drone) noexcept = 0;
  virtual void hide(swarm::DroneId drone, double for_s) noexcept = 0;  ///< the tracker does not see it for so long
  /// Nothing passes between it and the ground for so long, in either direction.
  virtual void cut_link(swarm::DroneId drone, double for_s) noexcept = 0;
  virtual void befall(swarm::DroneId drone, const Mishap& mishap) noexcept = 0;
  /// A station, counted in the mission's order, charges or no more. Simulators without any pass over it.
  virtual void set_station(std::size_t /*station*/, bool /*charges*/) noexcept {}
};

}  // namespace vigil::runtime
