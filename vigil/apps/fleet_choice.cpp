#include "vigil/apps/fleet_choice.hpp"

#include "vigil/adapters/ros/crazyswarm_link.hpp"
#include "vigil/adapters/ros/ros_fleet.hpp"
#include "vigil/adapters/sim/simulated_fleet.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::apps {
namespace {

using dynamics::VehicleKind;

bool is_autopilot(VehicleKind kind) { return kind != VehicleKind::kIdeal && kind != VehicleKind::kFirstOrderLag; }

sim::MotionModel motion_model(const runtime::Mission& mission) {
  const runtime::VehicleSection& vehicle = mission.simulation.vehicle;
  if (is_autopilot(vehicle.model)) return runtime::vehicle_model(mission).horizontal;
  return dynamics::PlanarVehicle{.lag_s = vehicle.lag_s, .acceleration_limit_m_s2 = vehicle.acceleration_limit_m_s2};
}

/// The model's battery; one that lasts for another time has another capacity, all else the same.
sim::BatteryParameters battery_parameters(const runtime::BatterySection& section, VehicleKind kind) {
  const bool is_outdoor = kind == VehicleKind::kArduCopter || kind == VehicleKind::kPx4;
  sim::BatteryParameters parameters{
      .battery = is_outdoor ? dynamics::outdoor_battery() : dynamics::crazyflie_battery(),
      .hover_power_w = is_outdoor ? dynamics::kOutdoorHoverPower : dynamics::kCrazyflieHoverPower,
      .start = section.start};
  if (section.endurance_s)
    parameters.battery.capacity_ah *=
        *section.endurance_s / dynamics::endurance_s(parameters.battery, parameters.hover_power_w);
  parameters.battery.health = section.health;
  return parameters;
}

sim::VehicleParameters vehicle_parameters(const runtime::Mission& mission) {
  const runtime::VehicleSection& vehicle = mission.simulation.vehicle;
  sim::VehicleParameters parameters;
  parameters.motion = motion_model(mission);
  parameters.failsafe = dynamics::failsafe_of(vehicle.model);
  parameters.position_hold_per_s = dynamics::position_hold_gain(vehicle.model);
  if (mission.simulation.battery) parameters.battery = battery_parameters(*mission.simulation.battery, vehicle.model);
  parameters.command_delay_s = vehicle.command_delay_s;
  parameters.altitude_m = vehicle.altitude_m;
  parameters.take_off_s = vehicle.take_off_s;
  parameters.landing_s = vehicle.landing_s;
  parameters.emergency_s = vehicle.emergency_s;
  return parameters;
}

double per_tick(const std::optional<double>& rate_hz, double dt_s) { return rate_hz ? *rate_hz * dt_s : 1.0; }

sim::TrackerParameters tracker_parameters(const runtime::TrackerSection& tracker, double dt_s) {
  return {.noise_m = tracker.noise_m,
          .velocity_noise_m_s = tracker.velocity_noise_m_s,
          .delay_s = tracker.delay_s,
          .jitter_s = tracker.jitter_s,
          .measurements_per_tick = per_tick(tracker.rate_hz, dt_s),
          .dropouts_per_min = tracker.dropouts_per_min,
          .dropout_s = tracker.dropout_s,
          .bias = {.sigma = tracker.bias_m, .time_s = tracker.bias_time_s}};
}

sim::LinkParameters link_parameters(const runtime::LinkSection& link, double dt_s) {
  return {.packets = dynamics::bursty_link(link.loss, link.burst_packets, link.delay_s, link.jitter_s),
          .packets_per_tick = per_tick(link.rate_hz, dt_s)};
}

dynamics::Wind wind(const runtime::Mission& mission) {
  const runtime::WindSection& section = mission.simulation.wind;
  const Vec2 mean = runtime::world_frame(mission).vector_to_field(section.mean_m_s);
  dynamics::Wind wind;
  wind.mean_m_s = Vec3(mean.x(), mean.y(), 0.0);
  wind.gusts = {.sigma = section.gust_m_s, .time_s = section.gust_time_s};
  wind.drag_per_s = section.drag_per_s;
  wind.rejection_time_s = section.rejection_time_s;
  return wind;
}

sim::FleetParameters fleet_parameters(const runtime::Mission& mission) {
  const runtime::SimulationSection& simulation = mission.simulation;
  const double dt_s = runtime::tick_s(mission);
  return {.vehicle = vehicle_parameters(mission),
          .tracker = tracker_parameters(simulation.tracker, dt_s),
          .confusion = {.swaps_per_h = simulation.tracker.swaps_per_h, .swap_s = simulation.tracker.swap_s},
          .link = link_parameters(simulation.link, dt_s),
          .wind = wind(mission),
          .positions_over_link = simulation.tracker.over_link,
          .dt_s = dt_s,
          .seed = simulation.seed,
          .starts_flying = simulation.start == runtime::StartState::kFlying,
          .pads = runtime::charging_pads(mission),
          .stays_down = {}};
}

}  // namespace

std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission, parallel::Workers* workers) {
  return std::make_unique<sim::SimulatedFleet>(fleet_parameters(mission), runtime::starts_in_field(mission), workers);
}

std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission,
                                                       std::span<const DroneStart> starts, parallel::Workers* workers) {
  sim::FleetParameters parameters = fleet_parameters(mission);
  parameters.starts_flying = true;
  std::vector<Vec2> places;
  for (const DroneStart& start : starts) {
    places.push_back(start.place_m);
    parameters.stays_down.push_back(start.is_down);
  }
  return std::make_unique<sim::SimulatedFleet>(parameters, places, workers);
}

std::unique_ptr<runtime::Fleet> crazyswarm_fleet(const runtime::Mission& mission, bool positions_by_tf,
                                                 std::function<void(const std::string&)> tell) {
  const runtime::VehicleSection& vehicle = mission.simulation.vehicle;
  ros_bridge::CrazyswarmSetup setup{.drones = {},
                                    .positions_by_tf = positions_by_tf,
                                    .altitude_m = vehicle.altitude_m,
                                    .take_off_s = vehicle.take_off_s,
                                    .landing_s = vehicle.landing_s,
                                    .tell = std::move(tell)};
  for (const runtime::DroneEntry& drone : mission.drones) setup.drones.push_back(drone.id);
  return std::make_unique<ros_bridge::RosFleet>(mission, ros_bridge::link_to_crazyswarm(setup));
}

}  // namespace vigil::apps
