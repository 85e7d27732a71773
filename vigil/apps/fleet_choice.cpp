#include "vigil/apps/fleet_choice.hpp"

#include "vigil/adapters/sim/simulated_fleet.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::apps {
namespace {

sim::VehicleParameters vehicle_parameters(const runtime::VehicleSection& vehicle) {
  sim::VehicleParameters parameters;
  if (vehicle.model == runtime::VehicleModel::kFirstOrderLag)
    parameters.motion = {.lag_s = vehicle.lag_s, .acceleration_limit_m_s2 = vehicle.acceleration_limit_m_s2};
  parameters.command_delay_s = vehicle.command_delay_s;
  parameters.altitude_m = vehicle.altitude_m;
  parameters.take_off_s = vehicle.take_off_s;
  parameters.landing_s = vehicle.landing_s;
  parameters.emergency_s = vehicle.emergency_s;
  return parameters;
}

sim::TrackerParameters tracker_parameters(const runtime::TrackerSection& tracker) {
  return {.noise_m = tracker.noise_m,
          .velocity_noise_m_s = tracker.velocity_noise_m_s,
          .delay_s = tracker.delay_s,
          .dropouts_per_min = tracker.dropouts_per_min,
          .dropout_s = tracker.dropout_s};
}

}  // namespace

std::unique_ptr<runtime::VirtualFleet> simulated_fleet(const runtime::Mission& mission) {
  const sim::FleetParameters parameters{.vehicle = vehicle_parameters(mission.simulation.vehicle),
                                        .tracker = tracker_parameters(mission.simulation.tracker),
                                        .dt_s = 1.0 / mission.control.rate_hz,
                                        .seed = mission.simulation.seed,
                                        .starts_flying = mission.simulation.start == runtime::StartState::kFlying};
  return std::make_unique<sim::SimulatedFleet>(parameters, runtime::starts_in_field(mission));
}

}  // namespace vigil::apps
