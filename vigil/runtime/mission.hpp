#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vigil/core/dynamics/vehicle_model.hpp"
#include "vigil/core/ergodic/controller_kind.hpp"
#include "vigil/core/ergodic/coverage_statistics.hpp"
#include "vigil/core/field/field.hpp"
#include "vigil/core/safety/filter.hpp"

/// A mission as its file says it: everything adjustable, once. Points are in the WORLD frame here (operators' and
/// trackers'); mission_setup.hpp turns them into the field-frame values of core/. Units stand in the names. Defaults
/// that depend on other values are `optional` here and resolved in mission_setup.hpp.
namespace vigil::runtime {

/// Where the world frame lies on the earth: its origin, with x to the east and y to the north. WGS 84.
struct DatumSection {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  friend bool operator==(const DatumSection&, const DatumSection&) = default;
};

struct FieldSection {
  Vec2 size_m = Vec2::Zero();    ///< L1, L2
  Vec2 origin_m = Vec2::Zero();  ///< the field's corner (0, 0) in the world
  double yaw_rad = 0.0;          ///< from the world's x axis to the field's, counter-clockwise
  std::optional<DatumSection> datum;
  friend bool operator==(const FieldSection&, const FieldSection&) = default;
};

struct ClusterEntry {
  std::string name;
  std::vector<Vec2> points_m;  ///< world frame, at least one
  double weight = 1.0;
  std::optional<double> revisit_s = std::nullopt;  ///< deadline: no part of it unseen for longer
  bool is_protected = false;                       ///< keeps its drones where there are fewer
  friend bool operator==(const ClusterEntry&, const ClusterEntry&) = default;
};

struct AreaEntry {
  std::string name;
  std::vector<Vec2> outline_m;  ///< world frame, a simple polygon
  double weight = 5.0;          ///< counts like that many target points
  double soft_edge_m = 0.0;
  std::optional<double> revisit_s = std::nullopt;
  bool is_protected = false;
  friend bool operator==(const AreaEntry&, const AreaEntry&) = default;
};

enum class OutsideField : std::uint8_t { kRefuse, kClamp };

struct TargetsSection {
  std::vector<ClusterEntry> clusters;
  std::vector<AreaEntry> areas;
  std::optional<double> sigma_min_m;  ///< default 5 % of the field's shorter side
  double uniform_floor = 0.0;         ///< share of attention spread evenly, [0, 1]
  OutsideField outside_field = OutsideField::kRefuse;
  friend bool operator==(const TargetsSection&, const TargetsSection&) = default;
};

/// The vertices of all no-fly polygons together: the filter looks at every edge for every drone in every tick.
inline constexpr std::size_t kMostNoFlyPoints = 1000;

struct NoFlyEntry {
  std::string name;
  std::vector<Vec2> outline_m;  ///< world frame, a simple polygon
  friend bool operator==(const NoFlyEntry&, const NoFlyEntry&) = default;
};

struct DroneEntry {
  std::string id;
  Vec2 start_m = Vec2::Zero();  ///< world frame
  friend bool operator==(const DroneEntry&, const DroneEntry&) = default;
};

/// A place where drones come down to have their batteries charged, and rise again by themselves.
struct StationEntry {
  std::string name;
  std::vector<Vec2> pads_m;   ///< world frame, at least one; each for one drone
  double full_in_s = 3600.0;  ///< from empty to full
  double pad_radius_m = 0.5;  ///< a drone that comes down within it is charged
  friend bool operator==(const StationEntry&, const StationEntry&) = default;
};

/// The pads of all stations together: each is looked at when a drone is to be sent to one.
inline constexpr std::size_t kMostPads = 1000;

/// Instead of `drones`: so many drones on a regular grid inside the field, ids prefix1, prefix2, ...
struct DroneGridSection {
  int count = 0;
  std::string prefix = "d";
  std::optional<double> spacing_m;  ///< default: as wide as the field allows
  friend bool operator==(const DroneGridSection&, const DroneGridSection&) = default;
};

enum class Memory : std::uint8_t {
  kFading,  ///< past coverage fades, so that a new target does not wait until hours of it are evened out
  kEndless  ///< (4): a plain average over all time
};

struct ControlSection {
  double rate_hz = 50.0;
  double speed_limit_m_s = 0.0;  ///< u_max
  ergodic::ControllerKind controller = ergodic::ControllerKind::kLookAhead;
  std::optional<double> look_ahead_s;  ///< `look_ahead`: its horizon; default from field, speed and active drones
  double fade = 0.1;  ///< `gradient`: delta of the faded gradient, in units of gradient_scale(); 0: (9) to the letter
  int basis_max_index = 10;       ///< K
  double basis_smoothness = 1.5;  ///< s of lambda_k
  ergodic::Accounting accounting = ergodic::Accounting::kDroneTime;
  Memory memory = Memory::kFading;
  std::optional<double> memory_s;  ///< time constant of kFading; default from field and speed, see mission_setup.hpp
  friend bool operator==(const ControlSection&, const ControlSection&) = default;
};

enum class Obstacles : std::uint8_t {
  kAirborne,   ///< whatever is in the air repels the others, active or not
  kActiveOnly  ///< the paper: a drone that is not active is no obstacle, wherever it is
};

/// The vehicle that the filter is set up for.
enum class AssumedVehicle : std::uint8_t { kSimulated, kCrazyflie, kArduCopter, kPx4 };

struct SafetySection {
  safety::BarrierKind barrier = safety::BarrierKind::kLagAware;
  double separation_m = 0.0;                 ///< R_s
  std::optional<double> contact_distance_m;  ///< default: half of R_s
  double wall_distance_m = 0.0;              ///< R_wall
  std::optional<double> no_fly_buffer_m;     ///< default: R_wall
  std::optional<double> pair_gain;           ///< default 10 for `paper`, derived for `lag_aware`
  std::optional<double> wall_gain;
  AssumedVehicle vehicle = AssumedVehicle::kSimulated;  ///< for which what is absent below is derived
  std::optional<double> lag_s;                          ///< default derived, like all that follows
  std::optional<double> margin_m;                       ///< beyond walls and no-fly buffers
  std::optional<double> pair_margin_m;                  ///< beyond R_s; where margin_m is given: twice that
  std::optional<double> command_delay_s;                ///< made up for
  std::optional<double> observation_delay_s;            ///< made up for
  std::optional<double> sensing_range_m;                ///< default derived
  std::optional<double> wall_range_m;                   ///< R_threat, default derived
  Obstacles obstacles = Obstacles::kAirborne;
  friend bool operator==(const SafetySection&, const SafetySection&) = default;
};

/// When a drone stops counting as flying normally (12).
struct HealthSection {
  double tracking_timeout_s = 0.5;
  double link_timeout_s = 1.0;
  double battery_reserve = 0.2;       ///< share of a full battery, [0, 1]
  double recovery_s = 0.5;            ///< healthy for so long before it is active again
  double landed_height_m = 0.05;      ///< below this a drone is down: no obstacle any more
  std::optional<double> endurance_s;  ///< about how long a full battery flies; default: the simulated one, when new
  friend bool operator==(const HealthSection&, const HealthSection&) = default;
};

struct SensorSection {
  std::optional<double> footprint_radius_m;  ///< a place within it of a drone is seen; default 10 % of the shorter side
  friend bool operator==(const SensorSection&, const SensorSection&) = default;
};

struct VehicleSection {
  dynamics::VehicleKind model = dynamics::VehicleKind::kIdeal;
  double lag_s = 0.0;                             ///< first_order_lag: v' = (u - v)/lag
  std::optional<double> acceleration_limit_m_s2;  ///< first_order_lag: |v'| at most this; none: no limit
  double command_delay_s = 0.0;                   ///< from decision to reaction, beside link and the model's dead time
  double altitude_m = 1.0;                        ///< where it flies
  double take_off_s = 2.0;                        ///< from the ground to there
  double landing_s = 2.0;                         ///< from there to the ground
  double emergency_s = 0.5;                       ///< from there to the ground with the motors off
  friend bool operator==(const VehicleSection&, const VehicleSection&) = default;
};

struct TrackerSection {
  std::optional<double> rate_hz;    ///< measurements; default every tick
  double noise_m = 0.0;             ///< standard deviation per axis
  double velocity_noise_m_s = 0.0;  ///< standard deviation per axis
  double bias_m = 0.0;              ///< standard deviation per axis of a slowly wandering error
  double bias_time_s = 60.0;        ///< its correlation time
  double delay_s = 0.0;             ///< age of a measurement when it arrives, at least
  double jitter_s = 0.0;            ///< on top of it, uniform
  double dropouts_per_min = 0.0;    ///< per drone, on average
  double dropout_s = 0.5;           ///< mean length of one
  double swaps_per_h = 0.0;         ///< of two bodies, in the whole swarm, on average
  double swap_s = 1.0;              ///< length of one
  bool over_link = false;           ///< vehicles find their own position and send it
  friend bool operator==(const TrackerSection&, const TrackerSection&) = default;
};

/// Moving air, as core/dynamics/wind.hpp has it.
struct WindSection {
  Vec2 mean_m_s = Vec2::Zero();  ///< world frame
  double gust_m_s = 0.0;         ///< standard deviation per axis
  double gust_time_s = 3.0;      ///< their correlation time
  double drag_per_s = 0.3;
  double rejection_time_s = 1.5;
  friend bool operator==(const WindSection&, const WindSection&) = default;
};

/// The radio, each direction of each drone by itself.
struct LinkSection {
  double loss = 0.0;           ///< share of packets
  double burst_packets = 1.0;  ///< mean length of a loss
  double delay_s = 0.0;
  double jitter_s = 0.0;          ///< on top of the delay, uniform
  std::optional<double> rate_hz;  ///< packets of each direction; default every tick
  friend bool operator==(const LinkSection&, const LinkSection&) = default;
};

struct BatterySection {
  double start = 1.0;                 ///< share of what it can hold
  double health = 1.0;                ///< share of a new one's capacity
  std::optional<double> endurance_s;  ///< of a full new one; default the model's
  friend bool operator==(const BatterySection&, const BatterySection&) = default;
};

enum class EventKind : std::uint8_t {
  kTakeOff,         ///< operator: take off
  kLand,            ///< operator: land where it is
  kHold,            ///< operator: hover, out of coverage
  kGoTo,            ///< operator: fly to point_m and wait there, out of coverage
  kResume,          ///< operator: back to coverage after hold, go_to or mark_failed
  kMarkFailed,      ///< operator: declare it failed
  kEmergencyStop,   ///< safety pilot: motors off
  kFail,            ///< the vehicle fails in the air: ignores commands, hovers where it stops
  kOverride,        ///< a pilot takes it over and flies velocity_m_s
  kGiveBack,        ///< the pilot gives it back
  kLoseTracking,    ///< the tracker does not see it for for_s
  kLoseLink,        ///< nothing passes between it and the ground for for_s
  kFreezeTracking,  ///< the tracker goes on telling its last place for for_s
  kShiftTracking,   ///< the tracker sees it shift_m from where it is for for_s
  kSwapTracking,    ///< the tracker takes it and `other` for each other for for_s
  kSkewVelocity,    ///< its velocity is reported with velocity_m_s added for for_s
  kIgnoreOrders,    ///< the vehicle hears its orders, and flies on as it flew for for_s
  kDrift,           ///< the vehicle flies velocity_m_s beside its orders for for_s
  kLandByItself,    ///< the vehicle lands though nobody asked
  kPilotUnasked,    ///< a pilot flies it at velocity_m_s though nobody said so
  kAddTarget,       ///< cluster (made where new), point_m
  kMoveTarget,      ///< cluster, target (counted from 1), point_m
  kRemoveTarget,    ///< cluster, target (counted from 1); the last one removes the cluster
  kSetWeight,       ///< cluster or area, weight
  kStartAfresh,     ///< coverage statistics are forgotten
  kFailStation,     ///< the station charges nobody any more
  kRepairStation    ///< ... and again
};

struct EventEntry {
  double at_s = 0.0;
  EventKind what = EventKind::kLand;
  std::string drone;  ///< an id, or "all"; for those that concern drones
  std::string cluster;
  int target = 0;
  Vec2 point_m = Vec2::Zero();       ///< world frame
  Vec2 velocity_m_s = Vec2::Zero();  ///< world frame
  double weight = 0.0;
  double for_s = 0.0;
  std::string other;            ///< the id of another drone
  std::string station;          ///< the name of one
  Vec2 shift_m = Vec2::Zero();  ///< world frame
  friend bool operator==(const EventEntry&, const EventEntry&) = default;
};

enum class StartState : std::uint8_t { kFlying, kGrounded };

inline constexpr double kLongestDurationS = 1e6;

enum class GoalPattern : std::uint8_t {
  kErrands,  ///< one random place after another
  kPlaces,   ///< each drone one random place, apart from each other
  kSwap      ///< each drone the place opposite to its start, through the field's centre
};

/// Operators' go_to for every drone, so that a crowd has somewhere to go.
struct GoalsSection {
  GoalPattern pattern = GoalPattern::kErrands;
  std::optional<double> radius_m;  ///< closer than this a goal is reached; default 0.6 times the barrier's radius
  friend bool operator==(const GoalsSection&, const GoalsSection&) = default;
};

struct SimulationSection {
  double duration_s = 120.0;
  std::uint64_t seed = 1;
  StartState start = StartState::kFlying;  ///< grounded: an operator's take_off event brings them up
  VehicleSection vehicle;
  std::optional<BatterySection> battery;  ///< none: no battery is simulated, and none reported
  WindSection wind;
  LinkSection link;
  TrackerSection tracker;
  std::optional<GoalsSection> goals;  ///< none: drones cover
  std::vector<EventEntry> events;     ///< in the order of at_s
  friend bool operator==(const SimulationSection&, const SimulationSection&) = default;
};

struct Mission {
  int format = 1;
  std::string name;
  std::string description;
  FieldSection field;
  TargetsSection targets;
  std::vector<NoFlyEntry> no_fly;
  std::vector<DroneEntry> drones;  ///< resolved from drone_grid where that is given
  std::optional<DroneGridSection> drone_grid;
  std::vector<StationEntry> stations;
  ControlSection control;
  SafetySection safety;
  HealthSection health;
  SensorSection sensor;
  SimulationSection simulation;
  friend bool operator==(const Mission&, const Mission&) = default;
};

}  // namespace vigil::runtime
