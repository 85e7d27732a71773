#include <array>

#include "vigil/runtime/mission_description.hpp"

namespace vigil::runtime {
namespace {

constexpr std::array<Choice, 5> kVehicleModel{{
    {"ideal", "(3): the velocity is the command"},
    {"first_order_lag", "v' = (u - v) / lag_s, with |v'| limited where acceleration_limit_m_s2 is given"},
    {"crazyflie",
     "a Crazyflie as recorded: second order, 0.88 of what is commanded; silent for 0.5 s it hovers, for 2 s "
     "it falls"},
    {"arducopter",
     "ArduCopter as recorded: acceleration and jerk limited, 0.12 s of dead time; silent for 3 s it "
     "hovers"},
    {"px4",
     "PX4 as recorded: slow integral, strong drag, 0.135 s of dead time; silent for 1 s it hovers and takes no "
     "velocity any more"},
}};

constexpr std::array<Choice, 2> kStartState{{
    {"flying", "every drone hovers at its start"},
    {"grounded", "every drone stands at its start until a take_off event"},
}};

constexpr std::array<Choice, 27> kEventKind{{
    {"take_off", "the operator lets a drone take off"},
    {"land", "the operator lets a drone land where it is"},
    {"hold", "the operator lets a drone hover, out of coverage"},
    {"go_to", "the operator sends a drone to point_m, where it waits, out of coverage"},
    {"resume", "the operator sends a drone back to coverage after hold, go_to or mark_failed"},
    {"mark_failed", "the operator declares a drone failed"},
    {"emergency_stop", "the safety pilot stops a drone's motors"},
    {"fail", "a vehicle fails in the air: it ignores commands and hovers where it stops"},
    {"override", "a pilot takes a drone over and flies it at velocity_m_s"},
    {"give_back", "the pilot gives the drone back"},
    {"lose_tracking", "the tracker does not see a drone for for_s"},
    {"lose_link", "nothing passes between a drone and the ground for for_s"},
    {"freeze_tracking", "the tracker goes on telling a drone's last place, as if it were new, for for_s"},
    {"shift_tracking", "the tracker sees a drone shift_m from where it is for for_s"},
    {"swap_tracking", "the tracker takes a drone and another for each other for for_s"},
    {"skew_velocity", "a drone's velocity is reported with velocity_m_s added for for_s"},
    {"ignore_orders", "a vehicle hears its orders, and flies on as it flew for for_s"},
    {"drift", "a vehicle flies velocity_m_s beside what it is told for for_s"},
    {"land_by_itself", "a vehicle lands though nobody asked it to"},
    {"pilot_unasked", "a pilot takes a drone though nobody said so, and flies it at velocity_m_s"},
    {"add_target", "a target point joins a cluster, which is made where it is new"},
    {"move_target", "a target point of a cluster moves"},
    {"remove_target", "a target point leaves its cluster; the last one removes the cluster"},
    {"set_weight", "a cluster or area gets another weight"},
    {"start_afresh", "all coverage so far is forgotten"},
    {"fail_station", "a station charges nobody any more; drones have to notice"},
    {"repair_station", "a station charges again"},
}};

constexpr std::array<Choice, 3> kGoalPattern{{
    {"errands", "one random place after another"},
    {"places", "each drone one random place, where it stays; all of them apart from each other"},
    {"swap", "each drone the place opposite to its start, through the field's centre"},
}};

constexpr Range kDuration{0.0, 600.0};
constexpr Range kNoise{0.0, 1000.0};
constexpr Range kWorldCoordinate{-2e7, 2e7};

void describe_drone(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.text({.name = "drone", .meaning = "the id of a drone, or `all`", .is_required = true}, TextRule::kIdentifier,
               event.drone);
}

void describe_cluster(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.text(
      {.name = "cluster", .meaning = "the name of a cluster; for set_weight also of an area", .is_required = true},
      TextRule::kName, event.cluster);
}

void describe_target(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.whole_number(
      {.name = "target", .meaning = "the number of a point of the cluster, counted from 1", .is_required = true},
      {1, 100'000}, event.target);
}

void describe_point(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.point({.name = "point_m", .meaning = "the target point, world frame", .unit = "m", .is_required = true},
                kWorldCoordinate, event.point_m);
}

void describe_time(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.number({.name = "for_s", .meaning = "the time for which it lasts", .unit = "s", .is_required = true},
                 {0.0, 1e6, false}, event.for_s);
}

void describe_velocity(DescriptionVisitor& visitor, EventEntry& event, const char* meaning) {
  visitor.point({.name = "velocity_m_s", .meaning = meaning, .unit = "m/s", .is_required = true}, {-100.0, 100.0},
                event.velocity_m_s);
}

/// What happens to a drone or its tracker for a while.
void describe_mishap(DescriptionVisitor& visitor, EventEntry& event) {
  describe_drone(visitor, event);
  if (event.what == EventKind::kShiftTracking)
    visitor.point(
        {.name = "shift_m", .meaning = "how far off it is seen, world frame", .unit = "m", .is_required = true},
        {-1e5, 1e5}, event.shift_m);
  if (event.what == EventKind::kSwapTracking)
    visitor.text({.name = "other", .meaning = "the id of the other drone", .is_required = true}, TextRule::kIdentifier,
                 event.other);
  if (event.what == EventKind::kSkewVelocity)
    describe_velocity(visitor, event, "what is added to the velocity that is told, world frame");
  if (event.what == EventKind::kDrift)
    describe_velocity(visitor, event, "what it flies beside its orders, world frame");
  if (event.what != EventKind::kLandByItself) describe_time(visitor, event);
}

/// The keys that an event of its kind needs; no others are allowed.
void describe_particulars(DescriptionVisitor& visitor, EventEntry& event) {
  switch (event.what) {
    case EventKind::kTakeOff:
    case EventKind::kLand:
    case EventKind::kHold:
    case EventKind::kResume:
    case EventKind::kMarkFailed:
    case EventKind::kEmergencyStop:
    case EventKind::kFail:
    case EventKind::kGiveBack:
      describe_drone(visitor, event);
      return;
    case EventKind::kGoTo:
      describe_drone(visitor, event);
      visitor.point({.name = "point_m", .meaning = "where to, world frame", .unit = "m", .is_required = true},
                    kWorldCoordinate, event.point_m);
      return;
    case EventKind::kOverride:
    case EventKind::kPilotUnasked:
      describe_drone(visitor, event);
      describe_velocity(visitor, event, "what the pilot flies, world frame");
      return;
    case EventKind::kLoseTracking:
    case EventKind::kLoseLink:
    case EventKind::kFreezeTracking:
    case EventKind::kShiftTracking:
    case EventKind::kSwapTracking:
    case EventKind::kSkewVelocity:
    case EventKind::kIgnoreOrders:
    case EventKind::kDrift:
    case EventKind::kLandByItself:
      describe_mishap(visitor, event);
      return;
    case EventKind::kAddTarget:
      describe_cluster(visitor, event);
      describe_point(visitor, event);
      return;
    case EventKind::kMoveTarget:
      describe_cluster(visitor, event);
      describe_target(visitor, event);
      describe_point(visitor, event);
      return;
    case EventKind::kRemoveTarget:
      describe_cluster(visitor, event);
      describe_target(visitor, event);
      return;
    case EventKind::kSetWeight:
      describe_cluster(visitor, event);
      visitor.number({.name = "weight", .meaning = "the new weight", .is_required = true}, {0.0, 1e6}, event.weight);
      return;
    case EventKind::kStartAfresh:
      return;
    case EventKind::kFailStation:
    case EventKind::kRepairStation:
      visitor.text({.name = "station", .meaning = "the name of a station", .is_required = true}, TextRule::kName,
                   event.station);
      return;
  }
}

}  // namespace

void describe(DescriptionVisitor& visitor, SimulationSection& simulation) {
  visitor.number({.name = "duration_s", .meaning = "the time that is simulated, at least one tick", .unit = "s"},
                 {0.0, kLongestDurationS, false}, simulation.duration_s);
  visitor.whole_number({.name = "seed", .meaning = "the seed of everything random; same seed, same bytes"},
                       {0, std::int64_t{1} << 53U}, simulation.seed);
  visitor.choice({.name = "start", .meaning = "how drones are found at the start"}, kStartState, simulation.start);
  visitor.section({.name = "vehicle", .meaning = "how a vehicle follows its velocity command"},
                  [&](DescriptionVisitor& v) { describe(v, simulation.vehicle); });
  visitor.optional_section(
      {.name = "battery", .meaning = "batteries that wear down in the air; without it none does, and none is reported"},
      {.is_present = simulation.battery.has_value(),
       .create = [&] { simulation.battery.emplace(); },
       .describe = [&](DescriptionVisitor& v) { describe(v, *simulation.battery); }});
  visitor.section(
      {.name = "wind",
       .meaning = "the moving air: a vehicle leans against its mean and is pushed by its gusts, each by its "
                  "own"},
      [&](DescriptionVisitor& v) { describe(v, simulation.wind); });
  visitor.section({.name = "link",
                   .meaning = "the radio between the ground and each drone: orders pass it upwards, mode and battery "
                              "(and the position, with tracker.over_link) downwards, each direction by itself"},
                  [&](DescriptionVisitor& v) { describe(v, simulation.link); });
  visitor.section({.name = "tracker", .meaning = "how positions are measured"},
                  [&](DescriptionVisitor& v) { describe(v, simulation.tracker); });
  visitor.optional_section(
      {.name = "goals", .meaning = "places to which the drones are sent, instead of covering; for trying out crowds"},
      {.is_present = simulation.goals.has_value(),
       .create = [&] { simulation.goals.emplace(); },
       .describe = [&](DescriptionVisitor& v) { describe(v, *simulation.goals); }});
  visitor.list({.name = "events", .meaning = "what happens when, in the order of at_s"}, {0, 10'000},
               sections_of(simulation.events));
}

void describe(DescriptionVisitor& visitor, VehicleSection& vehicle) {
  visitor.choice({.name = "model", .meaning = "the equation of motion"}, kVehicleModel, vehicle.model);
  visitor.number({.name = "lag_s", .meaning = "the time constant of `first_order_lag`", .unit = "s"}, {0.0, 10.0},
                 vehicle.lag_s);
  visitor.number({.name = "acceleration_limit_m_s2",
                  .meaning = "the highest acceleration of `first_order_lag`",
                  .unit = "m/s^2",
                  .default_text = "none"},
                 {0.0, 1000.0, false}, vehicle.acceleration_limit_m_s2);
  visitor.number({.name = "command_delay_s",
                  .meaning = "the time from the controller's decision to the vehicle's reaction, beside those of the "
                             "link and of the model; whole delays are rounded to ticks",
                  .unit = "s"},
                 {0.0, 10.0}, vehicle.command_delay_s);
  visitor.number({.name = "altitude_m", .meaning = "the height at which it flies", .unit = "m"}, {0.0, 1e4, false},
                 vehicle.altitude_m);
  visitor.number({.name = "take_off_s", .meaning = "the time from the ground to there", .unit = "s"}, kDuration,
                 vehicle.take_off_s);
  visitor.number({.name = "landing_s", .meaning = "the time from there to the ground", .unit = "s"}, kDuration,
                 vehicle.landing_s);
  visitor.number(
      {.name = "emergency_s", .meaning = "the time from there to the ground with the motors off", .unit = "s"},
      kDuration, vehicle.emergency_s);
}

void describe(DescriptionVisitor& visitor, BatterySection& battery) {
  visitor.number({.name = "start", .meaning = "the charge at the start, as a share of what the battery can hold"},
                 {0.0, 1.0, false}, battery.start);
  visitor.number({.name = "health",
                  .meaning = "the share of a new battery's capacity that age has left; its resistance grows as 1 / "
                             "health"},
                 {0.1, 1.0}, battery.health);
  visitor.number({.name = "endurance_s",
                  .meaning = "the time for which a full new one keeps a vehicle in the air; empty, a vehicle lands",
                  .unit = "s",
                  .default_text = "about 1200 s for arducopter and px4, 420 s for the others"},
                 {1.0, 86'400.0}, battery.endurance_s);
}

void describe(DescriptionVisitor& visitor, WindSection& wind) {
  visitor.point({.name = "mean_m_s",
                 .meaning = "the mean wind, world frame; it pushes at take-off, until the vehicle has learnt to lean "
                            "against it",
                 .unit = "m/s"},
                {-50.0, 50.0}, wind.mean_m_s);
  visitor.number({.name = "gust_m_s", .meaning = "the standard deviation of the gusts, per axis", .unit = "m/s"},
                 {0.0, 50.0}, wind.gust_m_s);
  visitor.number({.name = "gust_time_s", .meaning = "the time over which gusts are alike", .unit = "s"}, {0.01, 3600.0},
                 wind.gust_time_s);
  visitor.number({.name = "drag_per_s",
                  .meaning = "the acceleration by a metre per second of wind that the vehicle does not lean against",
                  .unit = "1/s"},
                 {0.0, 10.0}, wind.drag_per_s);
  visitor.number({.name = "rejection_time_s",
                  .meaning = "the time constant with which it learns to lean against a change",
                  .unit = "s"},
                 {0.01, 3600.0}, wind.rejection_time_s);
}

void describe(DescriptionVisitor& visitor, LinkSection& link) {
  visitor.number({.name = "loss", .meaning = "the share of packets that is lost, on average"}, {0.0, 0.99}, link.loss);
  visitor.number({.name = "burst_packets",
                  .meaning = "how many packets are lost in a row, on average; at least loss / (1 - loss)",
                  .unit = "packets"},
                 {1.0, 1e6}, link.burst_packets);
  visitor.number({.name = "delay_s", .meaning = "the time that a packet takes, at least", .unit = "s"}, {0.0, 10.0},
                 link.delay_s);
  visitor.number({.name = "jitter_s",
                  .meaning = "what it may take on top of that, evenly distributed; what is overtaken is dropped",
                  .unit = "s"},
                 {0.0, 10.0}, link.jitter_s);
  visitor.number({.name = "rate_hz",
                  .meaning = "the packets per second in each direction, one a tick at most",
                  .unit = "Hz",
                  .default_text = "one a tick"},
                 {0.01, 1000.0}, link.rate_hz);
}

void describe(DescriptionVisitor& visitor, TrackerSection& tracker) {
  visitor.number({.name = "rate_hz",
                  .meaning = "the measurements per second, one a tick at most",
                  .unit = "Hz",
                  .default_text = "one a tick"},
                 {0.01, 1000.0}, tracker.rate_hz);
  visitor.number({.name = "noise_m", .meaning = "the standard deviation of a position, per axis", .unit = "m"}, kNoise,
                 tracker.noise_m);
  visitor.number(
      {.name = "velocity_noise_m_s", .meaning = "the standard deviation of a velocity, per axis", .unit = "m/s"},
      kNoise, tracker.velocity_noise_m_s);
  visitor.number(
      {.name = "bias_m",
       .meaning = "the standard deviation, per axis, of a position's slowly wandering error, each drone's its "
                  "own",
       .unit = "m"},
      kNoise, tracker.bias_m);
  visitor.number({.name = "bias_time_s", .meaning = "the time over which that error is alike", .unit = "s"},
                 {0.01, 1e6}, tracker.bias_time_s);
  visitor.number({.name = "delay_s", .meaning = "the age of a measurement when it arrives, at least", .unit = "s"},
                 {0.0, 10.0}, tracker.delay_s);
  visitor.number({.name = "jitter_s",
                  .meaning = "what may come on top of that, evenly distributed; what is overtaken is dropped",
                  .unit = "s"},
                 {0.0, 10.0}, tracker.jitter_s);
  visitor.number({.name = "dropouts_per_min",
                  .meaning = "the number of times a drone is lost from sight, on average",
                  .unit = "1/min"},
                 {0.0, 6000.0}, tracker.dropouts_per_min);
  visitor.number({.name = "dropout_s", .meaning = "the mean length of one", .unit = "s"}, {0.0, 600.0, false},
                 tracker.dropout_s);
  visitor.number({.name = "swaps_per_h",
                  .meaning = "the number of times that a drone and the one nearest to it are taken for each other, on "
                             "average in the whole swarm",
                  .unit = "1/h"},
                 {0.0, 36'000.0}, tracker.swaps_per_h);
  visitor.number({.name = "swap_s", .meaning = "the length of each", .unit = "s"}, {0.0, 600.0, false}, tracker.swap_s);
  visitor.truth(
      {.name = "over_link",
       .meaning = "vehicles find their own position and send it over the link: what the link loses or delays, "
                  "the position does"},
      tracker.over_link);
}

void describe(DescriptionVisitor& visitor, GoalsSection& goals) {
  visitor.choice({.name = "pattern", .meaning = "which places"}, kGoalPattern, goals.pattern);
  visitor.number({.name = "radius_m",
                  .meaning = "the distance within which a place counts as reached",
                  .unit = "m",
                  .default_text = "0.6 times the barrier's radius"},
                 {0.0, 1000.0, false}, goals.radius_m);
}

void describe(DescriptionVisitor& visitor, EventEntry& event) {
  visitor.number({.name = "at_s", .meaning = "the time from the start", .unit = "s", .is_required = true}, {0.0, 1e6},
                 event.at_s);
  auto chosen = static_cast<std::size_t>(event.what);
  visitor.variants({.name = "do", .meaning = "what happens", .is_required = true}, kEventKind, chosen,
                   [&](DescriptionVisitor& v) {
                     event.what = static_cast<EventKind>(chosen);
                     describe_particulars(v, event);
                   });
}

std::string_view name_of(StartState value) { return kStartState.at(static_cast<std::size_t>(value)).name; }
std::string_view name_of(EventKind value) { return kEventKind.at(static_cast<std::size_t>(value)).name; }

}  // namespace vigil::runtime
