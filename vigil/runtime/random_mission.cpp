#include "vigil/runtime/random_mission.hpp"

#include <numbers>
#include <random>

#include "vigil/runtime/drone_grid.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

/// Draws whatever a mission is made of. Own formulas, not the library's distributions: those differ between libraries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53);
  }
  std::size_t below(std::size_t n) { return engine_() % n; }
  bool coin() { return below(2) == 1; }
  std::optional<double> maybe(double low, double high) {
    return coin() ? std::optional(between(low, high)) : std::nullopt;
  }

  /// Names with all that needs quotes: blanks, signs, accents, words that YAML knows.
  std::string name(const std::string& distinct) {
    static const std::vector<std::string> kParts{"a",          "north west",
                                                 "\"quoted\"", "back\\slash",
                                                 "- dash",     "# hash",
                                                 "null",       "yes",
                                                 "1.5",        "\xC3\xA9\xF0\x9F\x9A\x81",
                                                 "{x: [1]}",   "&anchor",
                                                 "*",          "%",
                                                 "'",          "key: value",
                                                 "~",          ""};
    return kParts[below(kParts.size())] + distinct;
  }

 private:
  std::mt19937_64 engine_;
};

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : dice_(seed) {}

  Mission make() {
    mission_.name = dice_.name(" mission");
    mission_.description = dice_.coin() ? dice_.name("\ntwo lines\twith a tab") : "";
    mission_.field = {.size_m = {dice_.between(3.0, 9.0), dice_.between(3.0, 9.0)},
                      .origin_m = {dice_.between(-1e4, 1e4), dice_.between(-5.0, 5.0)},
                      .yaw_rad = dice_.between(-std::numbers::pi, std::numbers::pi),
                      .datum = {}};
    make_targets();
    make_no_fly();
    make_control();
    make_safety();
    make_stations();
    make_simulation();
    make_drones();
    if (dice_.coin()) mission_.field.datum = {dice_.between(-89.0, 89.0), dice_.between(-180.0, 180.0)};
    return mission_;
  }

 private:
  /// In the left quarter of the field, where no no-fly polygon is; world frame.
  Vec2 place() {
    const Vec2 share(dice_.between(0.0, 0.24), dice_.between(0.0, 1.0));
    return world_frame(mission_).point_to_world(share.cwiseProduct(mission_.field.size_m));
  }

  std::vector<Vec2> triangle(double from_x) {
    const auto corner = [&](double x, double y) {
      return world_frame(mission_).point_to_world(Vec2(from_x + x, y).cwiseProduct(mission_.field.size_m));
    };
    return {corner(0.0, dice_.between(0.0, 0.3)), corner(dice_.between(0.1, 0.2), 0.4),
            corner(0.0, dice_.between(0.5, 0.9))};
  }

  void make_targets() {
    TargetsSection& targets = mission_.targets;
    for (std::size_t i = dice_.below(4); i-- > 0;) {
      ClusterEntry cluster;
      cluster.name = dice_.name(" c" + std::to_string(i));
      cluster.points_m.push_back(place());
      for (std::size_t n = dice_.below(5); n-- > 0;) cluster.points_m.push_back(place());
      cluster.weight = dice_.between(0.0, 3.0);
      cluster.revisit_s = dice_.maybe(1.0, 100.0);
      cluster.is_protected = dice_.coin();
      targets.clusters.push_back(cluster);
    }
    for (std::size_t i = dice_.below(3); i-- > 0;) {
      targets.areas.push_back({.name = dice_.name(" a" + std::to_string(i)),
                               .outline_m = triangle(0.0),
                               .weight = dice_.between(0.0, 9.0),
                               .soft_edge_m = dice_.between(0.0, 1.0),
                               .revisit_s = dice_.maybe(1.0, 100.0),
                               .is_protected = dice_.coin()});
    }
    targets.sigma_min_m = dice_.maybe(0.05, 0.5);
    targets.uniform_floor = dice_.between(0.0, 1.0);
    targets.outside_field = dice_.coin() ? OutsideField::kClamp : OutsideField::kRefuse;
  }

  void make_no_fly() {
    if (dice_.coin()) mission_.no_fly.push_back({.name = dice_.name(" mast"), .outline_m = triangle(0.78)});
  }

  void make_control() {
    mission_.control = {
        .rate_hz = dice_.between(10.0, 100.0),
        .speed_limit_m_s = dice_.between(0.1, 0.5),
        .controller = dice_.coin() ? ergodic::ControllerKind::kGradient : ergodic::ControllerKind::kLookAhead,
        .look_ahead_s = dice_.maybe(0.1, 10.0),
        .fade = dice_.between(0.0, 1.0),
        .basis_max_index = static_cast<int>(1 + dice_.below(64)),
        .basis_smoothness = dice_.between(0.5, 3.0),
        .accounting = static_cast<ergodic::Accounting>(dice_.below(3)),
        .memory = dice_.coin() ? Memory::kFading : Memory::kEndless,
        .memory_s = std::nullopt};
    if (mission_.control.memory == Memory::kFading) mission_.control.memory_s = dice_.maybe(10.0, 1000.0);
  }

  void make_safety() {
    SafetySection& safety = mission_.safety;
    const bool is_paper = dice_.coin();
    safety.barrier = is_paper ? safety::BarrierKind::kPaper : safety::BarrierKind::kLagAware;
    safety.separation_m = dice_.between(0.05, 0.2);
    safety.contact_distance_m = dice_.maybe(0.01, 0.05);
    safety.wall_distance_m = dice_.between(0.0, 0.2);
    safety.no_fly_buffer_m = dice_.maybe(0.0, 0.1);
    safety.pair_gain = dice_.maybe(1.0, 20.0);
    safety.wall_gain = dice_.maybe(1.0, 20.0);
    safety.lag_s = is_paper ? 0.0 : dice_.between(0.0, 0.1);
    safety.margin_m = is_paper ? 0.0 : dice_.between(0.0, 0.05);
    safety.sensing_range_m = dice_.maybe(1.0, 2.0);
    safety.wall_range_m = dice_.maybe(1.0, 2.0);
    safety.obstacles = dice_.coin() ? Obstacles::kActiveOnly : Obstacles::kAirborne;
    mission_.health = {.tracking_timeout_s = dice_.between(0.1, 1.0),
                       .link_timeout_s = dice_.between(0.1, 1.0),
                       .battery_reserve = dice_.between(0.0, 0.9),
                       .recovery_s = dice_.between(0.0, 1.0),
                       .landed_height_m = dice_.between(0.0, 0.1),
                       .endurance_s = dice_.maybe(10.0, 1000.0)};
    mission_.sensor.footprint_radius_m = dice_.maybe(0.1, 1.0);
  }

  /// Above each other in the middle of the field's left half, where no no-fly polygon is.
  void make_stations() {
    for (std::size_t i = dice_.below(3); i-- > 0;) {
      const Vec2 share(0.4, 0.3 + 0.4 * static_cast<double>(i));
      mission_.stations.push_back(
          {.name = dice_.name(" s" + std::to_string(i)),
           .pads_m = {world_frame(mission_).point_to_world(share.cwiseProduct(mission_.field.size_m))},
           .full_in_s = dice_.between(1.0, 1000.0),
           .pad_radius_m = dice_.between(0.01, 1.0)});
    }
  }

  void make_simulation() {
    SimulationSection& simulation = mission_.simulation;
    const auto model = static_cast<dynamics::VehicleKind>(dice_.below(5));
    const bool lags = model == dynamics::VehicleKind::kFirstOrderLag;
    simulation.duration_s = dice_.between(100.0, 200.0);
    simulation.seed = dice_.below(std::size_t{1} << 53U);
    simulation.start = dice_.coin() ? StartState::kGrounded : StartState::kFlying;
    simulation.vehicle = {.model = model,
                          .lag_s = lags ? dice_.between(0.01, 0.5) : 0.0,
                          .acceleration_limit_m_s2 = lags ? dice_.maybe(1.0, 5.0) : std::nullopt,
                          .command_delay_s = dice_.between(0.0, 0.1),
                          .altitude_m = dice_.between(0.2, 5.0),
                          .take_off_s = dice_.between(0.0, 5.0),
                          .landing_s = dice_.between(0.0, 5.0),
                          .emergency_s = dice_.between(0.0, 1.0)};
    make_world();
    double at_s = 0.0;
    for (std::size_t i = dice_.below(12); i-- > 0;)
      simulation.events.push_back(make_event(at_s += dice_.between(0.0, 8.0)));
  }

  void make_world() {
    SimulationSection& simulation = mission_.simulation;
    const bool is_pushed = simulation.vehicle.model != dynamics::VehicleKind::kIdeal;
    if (dice_.coin())
      simulation.battery = {.start = dice_.between(0.1, 1.0),
                            .health = dice_.between(0.1, 1.0),
                            .endurance_s = dice_.maybe(10.0, 1000.0)};
    simulation.wind = {.mean_m_s = is_pushed ? Vec2(dice_.between(-5.0, 5.0), dice_.between(-5.0, 5.0)) : Vec2::Zero(),
                       .gust_m_s = is_pushed ? dice_.between(0.0, 3.0) : 0.0,
                       .gust_time_s = dice_.between(0.1, 10.0),
                       .drag_per_s = dice_.between(0.0, 1.0),
                       .rejection_time_s = dice_.between(0.1, 5.0)};
    simulation.link = {.loss = dice_.between(0.0, 0.5),
                       .burst_packets = dice_.between(1.0, 20.0),
                       .delay_s = dice_.between(0.0, 0.1),
                       .jitter_s = dice_.between(0.0, 0.1),
                       .rate_hz = dice_.maybe(1.0, 50.0)};
    if (dice_.coin())
      simulation.goals = {.pattern = static_cast<GoalPattern>(dice_.below(3)), .radius_m = dice_.maybe(0.05, 0.5)};
    const bool over_link = dice_.coin();
    simulation.tracker = {.rate_hz = dice_.maybe(1.0, 100.0),
                          .noise_m = dice_.between(0.0, 0.1),
                          .velocity_noise_m_s = dice_.between(0.0, 0.1),
                          .bias_m = dice_.between(0.0, 0.1),
                          .bias_time_s = dice_.between(1.0, 100.0),
                          .delay_s = dice_.between(0.0, 0.1),
                          .jitter_s = dice_.between(0.0, 0.1),
                          .dropouts_per_min = dice_.between(0.0, 3.0),
                          .dropout_s = dice_.between(0.1, 1.0),
                          .swaps_per_h = over_link ? 0.0 : dice_.between(0.0, 10.0),
                          .swap_s = dice_.between(0.1, 2.0),
                          .over_link = over_link};
  }

  /// Every kind of event; those of targets are about a cluster that the first of them makes.
  EventEntry make_event(double at_s) {
    EventEntry event;
    event.at_s = at_s;
    event.what = static_cast<EventKind>(dice_.below(27));
    if (event.what == EventKind::kSwapTracking) event.what = EventKind::kFreezeTracking;  // takes two drones
    const bool needs_cluster = event.what == EventKind::kMoveTarget || event.what == EventKind::kRemoveTarget ||
                               event.what == EventKind::kSetWeight;
    if (needs_cluster && targets_added_ == 0) event.what = EventKind::kAddTarget;
    const bool needs_station = event.what == EventKind::kFailStation || event.what == EventKind::kRepairStation;
    if (needs_station && mission_.stations.empty()) event.what = EventKind::kStartAfresh;
    if (event.what == EventKind::kStartAfresh) return event;
    if (needs_station) {
      event.station = mission_.stations.front().name;
      return event;
    }
    if (event.what < EventKind::kAddTarget) {
      event.drone = dice_.coin() ? "all" : "d1";
      if (event.what == EventKind::kOverride || event.what == EventKind::kPilotUnasked ||
          event.what == EventKind::kSkewVelocity || event.what == EventKind::kDrift)
        event.velocity_m_s = Vec2(dice_.between(-1.0, 1.0), dice_.between(-1.0, 1.0));
      if (event.what == EventKind::kGoTo) event.point_m = place();
      if (event.what == EventKind::kShiftTracking) event.shift_m = Vec2(dice_.between(-1.0, 1.0), 0.5);
      const bool lasts = event.what >= EventKind::kLoseTracking && event.what <= EventKind::kDrift;
      if (lasts) event.for_s = dice_.between(0.1, 5.0);
      return event;
    }
    event.cluster = "from above: [new]";
    if (event.what == EventKind::kAddTarget) ++targets_added_;
    if (event.what == EventKind::kMoveTarget || event.what == EventKind::kRemoveTarget) event.target = targets_added_;
    if (event.what == EventKind::kAddTarget || event.what == EventKind::kMoveTarget) event.point_m = place();
    if (event.what == EventKind::kSetWeight) event.weight = dice_.between(0.0, 5.0);
    if (event.what == EventKind::kRemoveTarget) --targets_added_;
    return event;
  }

  void make_drones() {
    const bool is_grid = mission_.no_fly.empty() && dice_.coin();
    if (is_grid) {
      mission_.drone_grid =
          DroneGridSection{.count = static_cast<int>(1 + dice_.below(20)), .spacing_m = dice_.maybe(0.4, 0.5)};
      mission_.drones = drones_on_grid(mission_, MissionSource("random mission"));
      return;
    }
    // A column in the middle of the field.
    const std::size_t count = 1 + dice_.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 share(dice_.between(0.4, 0.6), (static_cast<double>(i) + 1.0) / (static_cast<double>(count) + 1.0));
      mission_.drones.push_back(
          {.id = "d" + std::to_string(i + 1),
           .start_m = world_frame(mission_).point_to_world(share.cwiseProduct(mission_.field.size_m))});
    }
  }

  Dice dice_;
  Mission mission_;
  int targets_added_ = 0;
};

}  // namespace

Mission random_mission(std::uint64_t seed) { return Maker(seed).make(); }

}  // namespace vigil::runtime
