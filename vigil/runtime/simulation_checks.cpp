#include <fmt/format.h>

#include "vigil/runtime/mission_checks.hpp"

namespace vigil::runtime {
namespace {

using dynamics::VehicleKind;

/// Refuses a key that does nothing for the vehicle's model.
[[noreturn]] void refuse_for_model(const Mission& mission, const MissionSource& source, std::string key,
                                   std::string advice) {
  const VehicleKind model = mission.simulation.vehicle.model;
  source.refuse({.place = "",
                 .key = std::move(key),
                 .value = "",
                 .problem = fmt::format("has no meaning for the model `{}`", dynamics::name_of(model)),
                 .valid = "must be left out there",
                 .advice = std::move(advice)});
}

void check_lag_of_vehicle(const Mission& mission, const MissionSource& source) {
  const VehicleSection& vehicle = mission.simulation.vehicle;
  constexpr const char* kAdvice = "take `model: first_order_lag`, or leave it out";
  if (vehicle.model == VehicleKind::kFirstOrderLag) {
    if (vehicle.lag_s > 0.0) return;
    source.refuse({.place = "",
                   .key = "simulation.vehicle.lag_s",
                   .value = fmt::format("{:.6g}", vehicle.lag_s),
                   .problem = "is no time constant",
                   .valid = "must be above 0 s for the model `first_order_lag`",
                   .advice = "give the vehicle's time constant, or take `model: ideal`"});
  }
  if (vehicle.lag_s > 0.0) refuse_for_model(mission, source, "simulation.vehicle.lag_s", kAdvice);
  if (vehicle.acceleration_limit_m_s2)
    refuse_for_model(mission, source, "simulation.vehicle.acceleration_limit_m_s2", kAdvice);
}

void check_altitude(const Mission& mission, const MissionSource& source) {
  const double altitude_m = mission.simulation.vehicle.altitude_m;
  if (mission.health.landed_height_m < altitude_m) return;
  source.refuse({.place = "",
                 .key = "health.landed_height_m",
                 .value = fmt::format("{:.6g}", mission.health.landed_height_m),
                 .problem = "would take flying drones for landed ones",
                 .valid = fmt::format("must be below simulation.vehicle.altitude_m, {:.6g} m", altitude_m),
                 .advice = "take a lower height, or fly higher"});
}

void check_wind(const Mission& mission, const MissionSource& source) {
  if (mission.simulation.vehicle.model != VehicleKind::kIdeal) return;
  constexpr const char* kAdvice = "take another model, or leave it out: what follows its command at once feels no push";
  if (mission.simulation.wind.gust_m_s > 0.0) refuse_for_model(mission, source, "simulation.wind.gust_m_s", kAdvice);
  if (!mission.simulation.wind.mean_m_s.isZero(0.0))
    refuse_for_model(mission, source, "simulation.wind.mean_m_s", kAdvice);
}

/// Two states of a link cannot lose more than a burst and one good packet in turn make.
void check_link(const Mission& mission, const MissionSource& source) {
  const LinkSection& link = mission.simulation.link;
  const double shortest = link.loss / (1.0 - link.loss);
  constexpr double kRounding = 1e-9;
  if (link.burst_packets >= shortest - kRounding) return;
  source.refuse({.place = "",
                 .key = "simulation.link.burst_packets",
                 .value = fmt::format("{:.6g}", link.burst_packets),
                 .problem = fmt::format("is too short to lose {:.6g} % of all packets", 100.0 * link.loss),
                 .valid = fmt::format("must be at least loss / (1 - loss), {:.6g} packets", shortest),
                 .advice = "take longer bursts, or a smaller simulation.link.loss"});
}

void check_tracker(const Mission& mission, const MissionSource& source) {
  const TrackerSection& tracker = mission.simulation.tracker;
  if (!tracker.over_link || tracker.swaps_per_h <= 0.0) return;
  source.refuse({.place = "",
                 .key = "simulation.tracker.swaps_per_h",
                 .value = "",
                 .problem = "has no meaning where vehicles find their own position",
                 .valid = "must be left out with `over_link: true`",
                 .advice = "leave it out, or take `over_link: false`"});
}

}  // namespace

void check_simulation(const Mission& mission, const MissionSource& source) {
  check_lag_of_vehicle(mission, source);
  check_altitude(mission, source);
  check_wind(mission, source);
  check_link(mission, source);
  check_tracker(mission, source);
}

}  // namespace vigil::runtime
