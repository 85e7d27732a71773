#include "vigil/runtime/mission_explanation.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/core/field/density.hpp"
#include "vigil/runtime/fault_setup.hpp"
#include "vigil/runtime/mission_description.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

using Json = nlohmann::ordered_json;

/// One thing that is looked at and its share of all attention before no-fly polygons and borders cut it.
struct Share {
  std::string kind;
  std::string name;
  double share = 0.0;
  std::size_t points = 0;
  std::optional<double> revisit_s;
  bool is_protected = false;
};

std::vector<Share> shares_of(const Mission& mission) {
  std::vector<Share> shares;
  for (const ClusterEntry& cluster : mission.targets.clusters) {
    const std::size_t points = cluster.points_m.size();
    shares.push_back({"cluster", cluster.name, cluster.weight * static_cast<double>(points), points, cluster.revisit_s,
                      cluster.is_protected});
  }
  for (const AreaEntry& area : mission.targets.areas)
    shares.push_back({"area", area.name, area.weight, 0, area.revisit_s, area.is_protected});
  const double mass = std::accumulate(shares.begin(), shares.end(), 0.0,
                                      [](double sum, const Share& share) { return sum + share.share; });
  const double floor = mission.targets.uniform_floor;
  for (Share& share : shares) share.share = mass > 0.0 ? share.share / mass * (1.0 - floor) : 0.0;
  if (floor > 0.0) shares.push_back({"floor", "everywhere", mass > 0.0 ? floor : 1.0, 0, std::nullopt});
  return shares;
}

std::string in_words(double value, std::string_view unit) { return fmt::format("{:.6g} {}", value, unit); }

std::string given_or_derived(const std::optional<double>& given, double derived) {
  return given ? fmt::format("{} (given)", in_words(*given, "m")) : fmt::format("{} (derived)", in_words(derived, "m"));
}

std::string given_or_default(const std::optional<double>& given, double value) {
  return fmt::format("{} ({})", in_words(value, "m"), given ? "given" : "default");
}

field::GridShape grid_of(const Mission& mission) {
  return field::grid_shape(monitored_field(mission), importance(mission), mission.control.basis_max_index);
}

std::string line(std::string_view label, std::string_view text) { return fmt::format("  {:<12} {}\n", label, text); }

std::string explain_field(const Mission& mission) {
  const FieldSection& field = mission.field;
  std::string text = "field\n";
  text += line("size",
               fmt::format("{:.6g} m x {:.6g} m, {:.6g} m^2", field.size_m.x(), field.size_m.y(), field.size_m.prod()));
  text += line("placed", fmt::format("corner at [{:.6g}, {:.6g}] m in the world, turned by {:.6g} rad",
                                     field.origin_m.x(), field.origin_m.y(), field.yaw_rad));
  if (field.datum)
    text += line("on the earth", fmt::format("the world's origin at latitude {:.9g}, longitude {:.9g} degrees",
                                             field.datum->latitude_deg, field.datum->longitude_deg));
  for (const NoFlyEntry& entry : mission.no_fly) {
    const double area = field::area(polygon_in_field(mission, entry.outline_m));
    text +=
        line("no-fly", fmt::format("{}, {} vertices, {:.6g} m^2, kept {} away from", entry.name, entry.outline_m.size(),
                                   area, in_words(barrier_parameters(mission).no_fly_buffer_m, "m")));
  }
  return text;
}

std::string explain_share(const Share& share) {
  std::string text = fmt::format("{:5.1f} % {}", 100.0 * share.share, share.name);
  if (share.points > 0) text += fmt::format(", {} point{}", share.points, share.points == 1 ? "" : "s");
  if (share.revisit_s) text += fmt::format(", to be seen again within {}", in_words(*share.revisit_s, "s"));
  if (share.is_protected) text += ", protected where drones are fewer";
  return line(share.kind, text);
}

std::string explain_attention(const Mission& mission) {
  std::string text = "attention\n";
  for (const Share& share : shares_of(mission)) text += explain_share(share);
  const field::GridShape grid = grid_of(mission);
  text += line("spread", fmt::format("sigma_min {}, so that a single point is a proper Gaussian",
                                     given_or_default(mission.targets.sigma_min_m, sigma_min_m(mission))));
  text += line("map", fmt::format("{} x {} cells", grid.nx, grid.ny));
  return text;
}

std::string explain_drones(const Mission& mission) {
  std::string ids;
  constexpr std::size_t kMostShown = 8;
  for (std::size_t i = 0; i < std::min(kMostShown, mission.drones.size()); ++i) {
    ids += fmt::format("{}{}", ids.empty() ? "" : ", ", mission.drones[i].id);
  }
  if (mission.drones.size() > kMostShown) ids += fmt::format(", ... {}", mission.drones.back().id);
  std::string text = "drones\n";
  text += line("swarm", fmt::format("{}: {}", mission.drones.size(), ids));
  text += line("sees", fmt::format("places within {}",
                                   given_or_default(mission.sensor.footprint_radius_m, footprint_radius_m(mission))));
  for (const StationEntry& station : mission.stations) {
    text +=
        line("station", fmt::format("{}: {} pad{}, an empty battery is full in {}", station.name, station.pads_m.size(),
                                    station.pads_m.size() == 1 ? "" : "s", in_words(station.full_in_s, "s")));
  }
  return text;
}

std::string_view meaning_of(ergodic::Accounting accounting) {
  switch (accounting) {
    case ergodic::Accounting::kDroneTime:
      return "every drone-second counts alike; the paper prints (14) otherwise";
    case ergodic::Accounting::kElapsedTime:
      return "every second counts alike, the likely intent of (14)";
    case ergodic::Accounting::kPaperEq14:
      break;
  }
  return "(14) as printed";
}

std::string explain_controller(const Mission& mission) {
  const ControlSection& control = mission.control;
  if (control.controller == ergodic::ControllerKind::kGradient) {
    return fmt::format("gradient, fade {:.6g}{}", control.fade,
                       control.fade == 0.0 ? ": (9) to the letter" : ": (9) without chatter");
  }
  return fmt::format("look_ahead, {:.6g} s while {} drones are active{}", look_ahead_s(mission), mission.drones.size(),
                     control.look_ahead_s ? " (given)" : " (default; longer when fewer are)");
}

std::string explain_memory(const Mission& mission) {
  const std::optional<double> fading_s = memory_s(mission);
  if (!fading_s) return "endless: a plain average over all time, as in (4)";
  return fmt::format("past coverage fades with {} ({})", in_words(*fading_s, "s"),
                     mission.control.memory_s ? "given" : "default");
}

std::string explain_control(const Mission& mission) {
  const ControlSection& control = mission.control;
  std::string text = "control\n";
  text += line("tick", fmt::format("{:.6g} ms at {:.6g} Hz; at most {:.6g} m/s", 1e3 * tick_s(mission), control.rate_hz,
                                   control.speed_limit_m_s));
  text += line("controller", explain_controller(mission));
  text += line("basis", fmt::format("{} coefficients (K = {}), lambda_k = (1 + |k|^2)^-{:.6g}",
                                    (control.basis_max_index + 1) * (control.basis_max_index + 1),
                                    control.basis_max_index, control.basis_smoothness));
  text += line("accounting", fmt::format("{}: {}", name_of(control.accounting), meaning_of(control.accounting)));
  text += line("memory", explain_memory(mission));
  return text;
}

std::string explain_barrier(const safety::BarrierParameters& barrier) {
  if (barrier.kind == safety::BarrierKind::kPaper) {
    return fmt::format("paper: (10), (11) as printed, gamma(h) = {:.6g} h^3 for pairs, {:.6g} h^3 for walls",
                       barrier.pair_gain, barrier.wall_gain);
  }
  return fmt::format(
      "lag_aware: keeps {:.6g} m between drones that lag by {:.6g} s, gamma(h) = {:.6g} h for pairs, {:.6g} h for "
      "walls",
      safety::barrier_radius(barrier), barrier.lag_s, barrier.pair_gain, barrier.wall_gain);
}

std::string explain_safety(const Mission& mission) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  std::string text = "safety\n";
  text += line("barrier", explain_barrier(barrier));
  if (barrier.kind == safety::BarrierKind::kLagAware) {
    text += line("margins", fmt::format("{} between drones, {} to walls; `vigil margins` says what of",
                                        given_or_derived(mission.safety.pair_margin_m, barrier.pair_margin_m),
                                        given_or_derived(mission.safety.margin_m, barrier.margin_m)));
  }
  text +=
      line("separation", fmt::format("R_s {}; bodies touch at {}", in_words(barrier.separation_m, "m"),
                                     given_or_default(mission.safety.contact_distance_m, barrier.contact_distance_m)));
  text +=
      line("walls", fmt::format("R_wall {}; no say beyond {}", in_words(barrier.wall_distance_m, "m"),
                                barrier.wall_range_m ? fmt::format("{} (given)", in_words(*barrier.wall_range_m, "m"))
                                                     : "the distance at which they could hold a drone (derived)"));
  text += line("sensing", fmt::format("{}; at least {} is needed",
                                      given_or_derived(barrier.sensing_range_m, safety::derived_sensing_range(barrier)),
                                      in_words(safety::least_sensing_range(barrier), "m")));
  text += line("obstacles", mission.safety.obstacles == Obstacles::kAirborne
                                ? "airborne: whatever is in the air"
                                : "active_only: active drones alone, as in the paper");
  return text;
}

std::string event_in_words(const EventEntry& event) {
  const auto at = [](const Vec2& point) { return fmt::format("[{:.6g}, {:.6g}]", point.x(), point.y()); };
  std::string text(name_of(event.what));
  if (!event.drone.empty()) text += " " + event.drone;
  if (!event.cluster.empty()) text += " " + event.cluster;
  if (event.target > 0) text += fmt::format(" target {}", event.target);
  switch (event.what) {
    case EventKind::kOverride:
    case EventKind::kPilotUnasked:
      return text + " at " + at(event.velocity_m_s) + " m/s";
    case EventKind::kLoseTracking:
    case EventKind::kLoseLink:
    case EventKind::kFreezeTracking:
    case EventKind::kIgnoreOrders:
      return text + " for " + in_words(event.for_s, "s");
    case EventKind::kShiftTracking:
      return text + " by " + at(event.shift_m) + " m for " + in_words(event.for_s, "s");
    case EventKind::kSwapTracking:
      return text + " and " + event.other + " for " + in_words(event.for_s, "s");
    case EventKind::kSkewVelocity:
    case EventKind::kDrift:
      return text + " by " + at(event.velocity_m_s) + " m/s for " + in_words(event.for_s, "s");
    case EventKind::kAddTarget:
    case EventKind::kMoveTarget:
      return text + " to " + at(event.point_m) + " m";
    case EventKind::kFailStation:
    case EventKind::kRepairStation:
      return text + " " + event.station;
    case EventKind::kSetWeight:
      return text + fmt::format(" to {:.6g}", event.weight);
    default:
      return text;
  }
}

std::string explain_vehicle(const Mission& mission) {
  const VehicleSection& vehicle = mission.simulation.vehicle;
  const std::string_view name = dynamics::name_of(vehicle.model);
  switch (vehicle.model) {
    case dynamics::VehicleKind::kIdeal:
      return "ideal: its velocity is its command, (3)";
    case dynamics::VehicleKind::kFirstOrderLag:
      return fmt::format("{} of {}", name, in_words(vehicle.lag_s, "s"));
    default:
      break;
  }
  const dynamics::VelocityLoop loop = vehicle_model(mission).horizontal;
  return fmt::format("{}, as recorded; an order acts after {}", name,
                     in_words(vehicle.command_delay_s + mission.simulation.link.delay_s + loop.response_delay_s, "s"));
}

std::string explain_link(const LinkSection& link) {
  return fmt::format("loses {:.6g} % of its packets, {:.6g} in a row; {} and up to {} more; {}", 100.0 * link.loss,
                     link.burst_packets, in_words(link.delay_s, "s"), in_words(link.jitter_s, "s"),
                     link.rate_hz ? in_words(*link.rate_hz, "Hz") : "one packet a tick");
}

std::string explain_tracker(const TrackerSection& tracker) {
  std::string text =
      fmt::format("{}, noise {}, bias {}, {} old", tracker.over_link ? "satellites, over the link" : "bodies",
                  in_words(tracker.noise_m, "m"), in_words(tracker.bias_m, "m"), in_words(tracker.delay_s, "s"));
  if (tracker.rate_hz) text += ", " + in_words(*tracker.rate_hz, "Hz");
  if (tracker.dropouts_per_min > 0.0) text += fmt::format(", lost {:.6g} times a minute", tracker.dropouts_per_min);
  if (tracker.swaps_per_h > 0.0) text += fmt::format(", {:.6g} confusions an hour", tracker.swaps_per_h);
  return text;
}

/// What is simulated around the vehicles, where it is more than a perfect world.
std::string explain_world(const SimulationSection& simulation) {
  std::string text;
  if (simulation.battery) {
    text += line("battery", fmt::format("{:.6g} % charged, {:.6g} % of a new one's capacity",
                                        100.0 * simulation.battery->start, 100.0 * simulation.battery->health));
  }
  const WindSection& wind = simulation.wind;
  if (wind.gust_m_s > 0.0 || !wind.mean_m_s.isZero(0.0)) {
    text += line("wind", fmt::format("[{:.6g}, {:.6g}] m/s with gusts of {}", wind.mean_m_s.x(), wind.mean_m_s.y(),
                                     in_words(wind.gust_m_s, "m/s")));
  }
  if (simulation.link != LinkSection{}) text += line("link", explain_link(simulation.link));
  if (simulation.tracker != TrackerSection{}) text += line("tracker", explain_tracker(simulation.tracker));
  return text;
}

/// What a drone must not exceed to count as sound.
std::string explain_faults(const Mission& mission) {
  const dynamics::FaultBounds bounds = fault_parameters(mission).bounds;
  std::string text = "faults\n";
  text += line("jumped", fmt::format("farther than {} and {} from its last place, for {}", in_words(bounds.jump_m, "m"),
                                     in_words(bounds.reach_m_s, "m/s"), in_words(bounds.confirm_s, "s")));
  text += line("frozen", fmt::format("the same place for {}{}", in_words(bounds.frozen_s, "s"),
                                     bounds.never_repeats ? "" : ", and orders lead elsewhere"));
  text +=
      line("disobeys", fmt::format("{} from where its orders of the last {} lead, beside what those explain that may "
                                   "have got lost for {}",
                                   in_words(bounds.residual_m, "m"), in_words(1.0 / bounds.residual_leak_per_s, "s"),
                                   in_words(bounds.held_s, "s")));
  text +=
      line("disagrees", fmt::format("its velocity and its places by {} within {}", in_words(bounds.disagreement_m, "m"),
                                    in_words(1.0 / bounds.disagreement_leak_per_s, "s")));
  text += line("outside", fmt::format("{} beyond the border", in_words(bounds.outside_m, "m")));
  text +=
      line("lost", fmt::format("not seen for {}, not heard for {}", in_words(mission.health.tracking_timeout_s, "s"),
                               in_words(mission.health.link_timeout_s, "s")));
  return text;
}

std::string explain_simulation(const Mission& mission) {
  const SimulationSection& simulation = mission.simulation;
  std::string text = "simulation\n";
  text += line("lasts", fmt::format("{}, seed {}, starts {}", in_words(simulation.duration_s, "s"), simulation.seed,
                                    name_of(simulation.start)));
  text += line("vehicle", explain_vehicle(mission));
  text += explain_world(simulation);
  for (const EventEntry& event : simulation.events)
    text += line(fmt::format("{:.6g} s", event.at_s), event_in_words(event));
  return text;
}

Json attention_json(const Mission& mission) {
  Json attention = Json::array();
  for (const Share& share : shares_of(mission)) {
    Json entry{{"kind", share.kind}, {"name", share.name}, {"share", share.share}};
    if (share.points > 0) entry["points"] = share.points;
    if (share.revisit_s) entry["revisit_s"] = *share.revisit_s;
    if (share.is_protected) entry["protect"] = true;
    attention.push_back(std::move(entry));
  }
  return attention;
}

Json safety_json(const Mission& mission) {
  const safety::BarrierParameters barrier = barrier_parameters(mission);
  return {{"barrier", name_of(barrier.kind)},
          {"separation_m", barrier.separation_m},
          {"contact_distance_m", barrier.contact_distance_m},
          {"barrier_radius_m", safety::barrier_radius(barrier)},
          {"wall_distance_m", barrier.wall_distance_m},
          {"no_fly_buffer_m", barrier.no_fly_buffer_m},
          {"pair_gain", barrier.pair_gain},
          {"wall_gain", barrier.wall_gain},
          {"lag_s", barrier.lag_s},
          {"margin_m", barrier.margin_m},
          {"pair_margin_m", barrier.pair_margin_m},
          {"sensing_range_m", barrier.sensing_range_m.value_or(safety::derived_sensing_range(barrier))},
          {"least_sensing_range_m", safety::least_sensing_range(barrier)},
          {"wall_range_m", barrier.wall_range_m ? Json(*barrier.wall_range_m) : Json(nullptr)},
          {"obstacles", name_of(mission.safety.obstacles)}};
}

Json control_json(const Mission& mission) {
  const ControlSection& control = mission.control;
  return {{"rate_hz", control.rate_hz},
          {"speed_limit_m_s", control.speed_limit_m_s},
          {"controller", name_of(control.controller)},
          {"fade", control.fade},
          {"basis_max_index", control.basis_max_index},
          {"basis_smoothness", control.basis_smoothness},
          {"accounting", name_of(control.accounting)},
          {"look_ahead_s",
           control.controller == ergodic::ControllerKind::kLookAhead ? Json(look_ahead_s(mission)) : Json(nullptr)},
          {"memory", name_of(control.memory)},
          {"memory_s", memory_s(mission) ? Json(*memory_s(mission)) : Json(nullptr)}};
}

Json events_json(const Mission& mission) {
  Json events = Json::array();
  for (const EventEntry& event : mission.simulation.events) {
    events.push_back({{"at_s", event.at_s}, {"do", name_of(event.what)}, {"what", event_in_words(event)}});
  }
  return events;
}

Json datum_json(const FieldSection& field) {
  if (!field.datum) return nullptr;
  return {{"latitude_deg", field.datum->latitude_deg}, {"longitude_deg", field.datum->longitude_deg}};
}

}  // namespace

std::string explain(const Mission& mission) {
  std::string text = fmt::format("{}\n", mission.name);
  if (!mission.description.empty()) text += fmt::format("{}\n", mission.description);
  text += explain_field(mission) + explain_attention(mission) + explain_drones(mission) + explain_control(mission) +
          explain_safety(mission) + explain_faults(mission) + explain_simulation(mission);
  const std::vector<std::string> notes = notes_on(mission);
  if (!notes.empty()) text += "worth a second look\n";
  for (const std::string& note : notes) text += fmt::format("  - {}\n", note);
  return text;
}

nlohmann::ordered_json explanation_json(const Mission& mission) {
  const field::GridShape grid = grid_of(mission);
  Json drones = Json::array();
  for (const DroneEntry& drone : mission.drones) {
    drones.push_back({{"id", drone.id}, {"start_m", {drone.start_m.x(), drone.start_m.y()}}});
  }
  return {{"mission", mission.name},
          {"field",
           {{"size_m", {mission.field.size_m.x(), mission.field.size_m.y()}},
            {"origin_m", {mission.field.origin_m.x(), mission.field.origin_m.y()}},
            {"yaw_rad", mission.field.yaw_rad},
            {"datum", datum_json(mission.field)},
            {"no_fly", mission.no_fly.size()},
            {"cells", {grid.nx, grid.ny}}}},
          {"attention", attention_json(mission)},
          {"sigma_min_m", sigma_min_m(mission)},
          {"footprint_radius_m", footprint_radius_m(mission)},
          {"drones", std::move(drones)},
          {"control", control_json(mission)},
          {"safety", safety_json(mission)},
          {"duration_s", mission.simulation.duration_s},
          {"seed", mission.simulation.seed},
          {"vehicle", name_of(mission.simulation.vehicle.model)},
          {"events", events_json(mission)},
          {"notes", notes_on(mission)}};
}

}  // namespace vigil::runtime
