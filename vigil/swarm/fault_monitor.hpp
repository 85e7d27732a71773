#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/swarm/activity.hpp"
#include "vigil/swarm/fault.hpp"
#include "vigil/swarm/flown_orders.hpp"
#include "vigil/swarm/ordered_flight.hpp"

namespace vigil::swarm {

/// What the monitor knows beside its thresholds.
struct WatchSetup {
  FaultParameters parameters;
  field::Field field;
  double dt_s = 0.02;
  double command_delay_s = 0.0;
  double observation_delay_s = 0.0;
  HealthParameters health;
};

/// Watches whether what is reported of drones can be true, and whether they fly what they are told.
///
/// Positions. Each new one must lie within the drone's reach of the last that was believed. One that does not is as
/// good as none: what is known only grows older, and the drone stays where its orders lead. A stream of such positions
/// is a fault after confirm_s: kSwapped where it lies where another drone was last, kJumped otherwise. It is believed
/// again at once where it leaps back, and where it has stayed without a leap for confirm_s and recovery_s, is no other
/// drone's place, and the drone can have drifted there by now from where its orders lead, or, where nobody knows by
/// what it flies (not heard, failed, landing), can have flown there. Of drones on the ground and in a pilot's hands
/// everything is believed: they may be carried anywhere. A position that repeats itself to the last bit is as old as
/// its first appearance.
///
/// Motion. A model of the vehicle flies the same orders, as late as they act and are seen. The residual is the leaky
/// integral of what drone and model moved differently; orders that may have got lost explain as much of it as orders
/// have changed lately. Velocities are held against positions in the same way.
///
/// The derivations: docs/derivations/faults.md. A value; look() allocates nothing. One thread.
class FaultMonitor {
 public:
  FaultMonitor(const WatchSetup& setup, std::size_t drones);

  /// A place with its age.
  struct Sighting {
    Motion motion;
    double age_s = 0.0;
  };

  /// Whether it looks at all. Where it does not, there is nothing believed to ask for.
  [[nodiscard]] bool watches() const noexcept { return !watched_.empty(); }

  /// Takes one tick's observations in: what was remembered of the drones before, where they are expected, what they
  /// were ordered. Precondition: as many of each as drones.
  void look(std::span<const DroneObservation> observed, std::span<const DroneMemory> drones,
            std::span<const Motion> expected, const FlownOrders& flown) noexcept;

  /// What of a drone's observation is to be believed: another age, or no position at all, where it is doubted, and the
  /// velocity that its orders give it, where only the one that is reported is wrong.
  [[nodiscard]] const DroneObservation& believed(std::size_t drone) const noexcept { return watched_[drone].believed; }
  /// Where a drone is seen although it cannot be there: it may be what was believed before that was wrong, so others
  /// keep clear of both. None for as long as it may be a stray measurement, and where another drone is known to be.
  [[nodiscard]] std::optional<Sighting> doubted_sighting(std::size_t drone) const noexcept;
  /// kNone where nothing is wrong, or not for long enough yet.
  [[nodiscard]] const FaultReport& report(std::size_t drone) const noexcept { return watched_[drone].report; }

 private:
  /// The stream of positions under a drone's name, believed or not.
  struct Stream {
    Vec2 newest = Vec2::Zero();
    Vec2 velocity = Vec2::Zero();
    double newest_s = 0.0;
    double steady_since_s = 0.0;  ///< no leap since
    double changed_s = 0.0;       ///< since when it has been the same bits
    Vec2 model_at_change = Vec2::Zero();
    int repeats = 0;
    bool is_frozen = false;
  };
  /// What is above a threshold, or was a moment ago.
  struct Excess {
    bool is_raised = false;
    double since_s = 0.0;  ///< above the threshold; kNever: it is not
    double calm_s = 0.0;   ///< below half of it for so long
    int relapses = 0;
  };
  struct Watched {
    DroneObservation believed;
    FaultReport report;
    Stream stream;
    bool has_seen = false;
    bool is_ours = false;       ///< flies by our orders, as far as it says: its motion is judged
    bool is_bound = false;      ///< moves no faster than its kind does: its places are
    Vec2 place = Vec2::Zero();  ///< last believed
    Vec2 velocity = Vec2::Zero();
    double measured_s = 0.0;  ///< of place
    bool is_doubted = false;
    bool was_silent = false;  ///< while it was doubted: how it came from `place` to the next is not known
    double doubted_since_s = 0.0;
    double off_m = 0.0;  ///< how far the doubted position is out of reach
    std::optional<DroneId> other;
    OrderedFlight model;              ///< as it was observation_delay_s ago
    Vec2 model_place = Vec2::Zero();  ///< when `place` was true
    Vec2 residual = Vec2::Zero();
    Vec2 disagreement = Vec2::Zero();
    Excess residual_excess;
    Excess disagreement_excess;
    VehicleMode mode = VehicleMode::kUnknown;
    bool is_own_mode = false;
    double own_mode_since_s = 0.0;
    bool was_inside = false;
    bool is_outside = false;
    double outside_since_s = 0.0;
    bool is_silent = false;  ///< not heard for longer than losses explain
  };

  void fly_model(Watched& drone, std::size_t index, const FlownOrders& flown) const noexcept;
  void rest_model(Watched& drone, const Vec2& velocity) const noexcept;
  void take(std::size_t index, const DroneObservation& observed, const Motion& expected) noexcept;
  void take_new(std::size_t index, const DroneObservation& observed, double stamp_s, const Motion& expected) noexcept;
  [[nodiscard]] bool take_stream(Watched& drone, const DroneObservation& observed, double stamp_s) const noexcept;
  [[nodiscard]] bool is_credible(const Watched& drone, const Vec2& place, double stamp_s, const Motion& expected,
                                 bool has_leapt) const noexcept;
  [[nodiscard]] bool is_settled(const Watched& drone, const Vec2& place, double stamp_s,
                                const Motion& expected) const noexcept;
  [[nodiscard]] std::optional<DroneId> whose(std::size_t index, const Vec2& place) const noexcept;
  [[nodiscard]] double reach_m(double span_s) const noexcept;
  void doubt(Watched& drone, std::size_t index, const Vec2& place, bool has_leapt) const noexcept;
  void believe(Watched& drone, const DroneObservation& observed, double stamp_s, bool is_elsewhere) const noexcept;
  void compare(Watched& drone, const DroneObservation& observed, double stamp_s,
               const Vec2& model_place) const noexcept;
  void watch(Excess& excess, double measured, double threshold) const noexcept;
  void watch_motion(Watched& drone, double link_age_s) const noexcept;
  void watch_mode(Watched& drone, const DroneObservation& observed, const DroneMemory& memory) const noexcept;
  void watch_border(Watched& drone) const noexcept;
  void name_fault(Watched& drone) const noexcept;
  [[nodiscard]] static bool is_velocity_alone_wrong(const Watched& drone) noexcept;
  [[nodiscard]] double residual_threshold(const Watched& drone) const noexcept;
  [[nodiscard]] Vec2 model_place_at(const Watched& drone, double stamp_s) const noexcept;

  WatchSetup setup_;
  OrderedFlight::Rules rules_;
  std::size_t ago_ticks_ = 0;  ///< the order that is seen to act now was given so many ticks ago
  double ago_part_ = 0.0;      ///< and this part of a tick
  double now_s_ = 0.0;
  std::vector<Watched> watched_;
};

}  // namespace vigil::swarm
