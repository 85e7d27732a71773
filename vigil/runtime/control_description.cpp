#include <array>

#include "vigil/runtime/mission_description.hpp"
#include "vigil/swarm/parameters.hpp"

namespace vigil::runtime {
namespace {

constexpr std::array<Choice, 2> kController{{
    {"gradient", "(9): down the gradient of the ergodic metric"},
    {"look_ahead", "the next seconds of all drones' paths, improved together: covers many times better"},
}};

constexpr std::array<Choice, 3> kAccounting{{
    {"drone_time", "every drone-second counts alike; continuous when a drone drops out"},
    {"elapsed_time", "every second counts alike, shared by the drones active in it: the likely intent of (14)"},
    {"paper_eq14", "(14) as printed: the averages of all phases are added, so survivors spread evenly"},
}};

constexpr std::array<Choice, 2> kMemory{{
    {"fading", "with the time constant memory_s, so that new targets are soon covered to their share"},
    {"endless", "not at all: a plain average over all time, as in (4)"},
}};

constexpr std::array<Choice, 2> kBarrier{{
    {"paper", "(10), (11) as printed: safe for vehicles that follow their velocity at once"},
    {"lag_aware", "allows for vehicles that lag behind their velocity command by lag_s"},
}};

constexpr std::array<Choice, 2> kObstacles{{
    {"airborne", "whatever is in the air repels the others"},
    {"active_only", "the paper: a drone that is not active is no obstacle, wherever it is"},
}};

constexpr std::array<Choice, 4> kAssumedVehicle{{
    {"simulated", "that of `simulation.vehicle`"},
    {"crazyflie", "a Crazyflie as recorded"},
    {"arducopter", "ArduCopter as recorded"},
    {"px4", "PX4 as recorded"},
}};

constexpr Range kGain{0.0, 1e9, false};
constexpr Range kLength{0.0, 1e5, false};
constexpr Range kLengthOrZero{0.0, 1e5};

void describe_ranges(DescriptionVisitor& visitor, SafetySection& safety) {
  visitor.number({.name = "sensing_range_m",
                  .meaning = "the distance beyond which drones do not constrain each other",
                  .unit = "m",
                  .default_text = "where such a constraint could no longer hold a drone"},
                 kLength, safety.sensing_range_m);
  visitor.number({.name = "wall_range_m",
                  .meaning = "the distance R_threat beyond which a wall does not constrain",
                  .unit = "m",
                  .default_text = "where such a constraint could no longer hold a drone"},
                 kLength, safety.wall_range_m);
}

void describe_gains(DescriptionVisitor& visitor, SafetySection& safety) {
  constexpr std::string_view kDefault =
      "10 for `paper` (gamma(h) = gain h^3); for `lag_aware` (gain h, 1/s) derived, or 5 where lag_s and margin_m are "
      "given";
  visitor.number({.name = "pair_gain", .meaning = "how late drones give way to each other", .default_text = kDefault},
                 kGain, safety.pair_gain);
  visitor.number({.name = "wall_gain",
                  .meaning = "how late drones give way to walls and no-fly polygons",
                  .default_text = kDefault},
                 kGain, safety.wall_gain);
}

void describe_distances(DescriptionVisitor& visitor, SafetySection& safety) {
  visitor.number({.name = "separation_m",
                  .meaning = "the least allowed distance R_s between two drones' centres",
                  .unit = "m",
                  .is_required = true},
                 kLength, safety.separation_m);
  visitor.number({.name = "contact_distance_m",
                  .meaning = "the distance of two centres at which bodies touch; the last thing to give way",
                  .unit = "m",
                  .default_text = "half of separation_m"},
                 kLength, safety.contact_distance_m);
  visitor.number({.name = "wall_distance_m",
                  .meaning = "the least allowed distance R_wall from the field's border",
                  .unit = "m",
                  .is_required = true},
                 kLengthOrZero, safety.wall_distance_m);
  visitor.number({.name = "no_fly_buffer_m",
                  .meaning = "the least allowed distance from a no-fly polygon",
                  .unit = "m",
                  .default_text = "wall_distance_m"},
                 kLengthOrZero, safety.no_fly_buffer_m);
}

}  // namespace

void describe(DescriptionVisitor& visitor, ControlSection& control) {
  visitor.number({.name = "rate_hz", .meaning = "the ticks per second; a velocity is held for one tick", .unit = "Hz"},
                 {1.0, 1000.0}, control.rate_hz);
  visitor.number(
      {.name = "speed_limit_m_s", .meaning = "the highest speed u_max of a drone", .unit = "m/s", .is_required = true},
      {0.0, 100.0, false}, control.speed_limit_m_s);
  visitor.choice({.name = "controller", .meaning = "what steers the drones to their targets"}, kController,
                 control.controller);
  visitor.number({.name = "look_ahead_s",
                  .meaning = "how far the controller looks ahead; `look_ahead` only",
                  .unit = "s",
                  .default_text = "0.6 of the time in which a drone crosses its share of the field"},
                 {0.0, 1e5, false}, control.look_ahead_s);
  visitor.number({.name = "fade",
                  .meaning = "the share of its usual size below which a weak gradient slows drones down; 0: (9) to the "
                             "letter, full speed always; `gradient` only"},
                 {0.0, 1000.0}, control.fade);
  visitor.whole_number(
      {.name = "basis_max_index", .meaning = "the highest index K of the Fourier basis (5) on either axis"}, {1, 64},
      control.basis_max_index);
  visitor.number({.name = "basis_smoothness",
                  .meaning = "the exponent s of lambda_k = (1 + |k|^2)^-s: how much coarse scales come first"},
                 {0.0, 10.0, false}, control.basis_smoothness);
  visitor.choice({.name = "accounting", .meaning = "how coverage is averaged when drones drop out or return"},
                 kAccounting, control.accounting);
  visitor.choice({.name = "memory", .meaning = "whether past coverage fades"}, kMemory, control.memory);
  visitor.number({.name = "memory_s",
                  .meaning = "the time constant with which past coverage fades; `fading` only",
                  .unit = "s",
                  .default_text = "20 times what a drone needs along the field's longer side"},
                 {0.0, 1e9, false}, control.memory_s);
}

void describe(DescriptionVisitor& visitor, SafetySection& safety) {
  visitor.choice({.name = "barrier", .meaning = "the barrier function that keeps distances"}, kBarrier, safety.barrier);
  describe_distances(visitor, safety);
  describe_gains(visitor, safety);
  visitor.choice({.name = "vehicle",
                  .meaning = "the vehicle for which what follows is derived where it is not given; `lag_aware` only"},
                 kAssumedVehicle, safety.vehicle);
  visitor.number({.name = "lag_s",
                  .meaning = "the time constant with which a vehicle follows its velocity command; `lag_aware` only",
                  .unit = "s",
                  .default_text = "derived for the vehicle"},
                 {0.0, 10.0}, safety.lag_s);
  visitor.number(
      {.name = "margin_m",
       .meaning =
           "how far a drone may be from where it is believed to be, by noise, wind and limits: kept beyond walls "
           "and no-fly buffers; `lag_aware` only",
       .unit = "m",
       .default_text = "derived for the vehicle and the simulated world"},
      {0.0, 1000.0}, safety.margin_m);
  visitor.number({.name = "pair_margin_m",
                  .meaning = "the same for two drones: kept beyond separation_m; `lag_aware` only",
                  .unit = "m",
                  .default_text = "twice margin_m where that is given, otherwise derived"},
                 {0.0, 1000.0}, safety.pair_margin_m);
  visitor.number({.name = "command_delay_s",
                  .meaning = "from a decision to the moment at which vehicles begin to follow it: drones are steered "
                             "from where they will be then; `lag_aware` only",
                  .unit = "s",
                  .default_text = "derived: dead time, link, half of the time between two packets"},
                 {0.0, swarm::kLongestPredictionS}, safety.command_delay_s);
  visitor.number({.name = "observation_delay_s",
                  .meaning = "how old observations usually are: only what is older counts as unknown; `lag_aware` only",
                  .unit = "s",
                  .default_text = "derived: the greatest while nothing is lost"},
                 {0.0, swarm::kLongestPredictionS}, safety.observation_delay_s);
  describe_ranges(visitor, safety);
  visitor.choice({.name = "obstacles", .meaning = "which drones the others avoid"}, kObstacles, safety.obstacles);
}

void describe(DescriptionVisitor& visitor, HealthSection& health) {
  visitor.number(
      {.name = "tracking_timeout_s", .meaning = "the age of its position beyond which a drone is lost", .unit = "s"},
      {0.0, 60.0, false}, health.tracking_timeout_s);
  visitor.number({.name = "link_timeout_s", .meaning = "the silence beyond which a drone is lost", .unit = "s"},
                 {0.0, 600.0, false}, health.link_timeout_s);
  visitor.number(
      {.name = "battery_reserve", .meaning = "the share of a full battery below which a drone stops covering"},
      {0.0, 0.95}, health.battery_reserve);
  visitor.number({.name = "recovery_s",
                  .meaning = "the time for which a drone must be well before it is active again",
                  .unit = "s"},
                 {0.0, 600.0}, health.recovery_s);
  visitor.number({.name = "landed_height_m",
                  .meaning = "the height below which a drone is down and no obstacle any more",
                  .unit = "m"},
                 {0.0, 100.0}, health.landed_height_m);
  visitor.number({.name = "endurance_s",
                  .meaning = "about how long a full battery keeps a drone in the air: where drones are charged by "
                             "stations, what is believed of a battery until it has been watched",
                  .unit = "s",
                  .default_text = "that of the simulated battery when it is new"},
                 {10.0, 86'400.0}, health.endurance_s);
}

void describe(DescriptionVisitor& visitor, SensorSection& sensor) {
  visitor.number({.name = "footprint_radius_m",
                  .meaning = "the distance from a drone within which a place is seen",
                  .unit = "m",
                  .default_text = "10 % of the field's shorter side"},
                 kLength, sensor.footprint_radius_m);
}

std::string_view name_of(ergodic::ControllerKind value) { return kController.at(static_cast<std::size_t>(value)).name; }
std::string_view name_of(Memory value) { return kMemory.at(static_cast<std::size_t>(value)).name; }
std::string_view name_of(ergodic::Accounting value) { return kAccounting.at(static_cast<std::size_t>(value)).name; }
std::string_view name_of(safety::BarrierKind value) { return kBarrier.at(static_cast<std::size_t>(value)).name; }
std::string_view name_of(Obstacles value) { return kObstacles.at(static_cast<std::size_t>(value)).name; }

}  // namespace vigil::runtime
