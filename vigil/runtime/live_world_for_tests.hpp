#pragma once

#include <string>
#include <vector>

#include "vigil/runtime/fleet.hpp"
#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {

/// Drones that do at once what they are told, seen as they are.
class ObedientFleet final : public VirtualFleet {
 public:
  explicit ObedientFleet(std::vector<Vec2> starts) : truth_(starts.size()), orders_(starts.size()) {
    for (std::size_t i = 0; i < starts.size(); ++i)
      truth_[i] = {starts[i], Vec2::Zero(), 1.0, swarm::VehicleMode::kFlying};
  }

  [[nodiscard]] std::size_t size() const noexcept override { return truth_.size(); }
  void observe(MissionTime, std::span<swarm::DroneObservation> out) noexcept override {
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      out[i].position = truth_[i].position;
      out[i].velocity = truth_[i].velocity;
      out[i].height_m = truth_[i].height_m;
      out[i].age_s = 0.0;
      out[i].mode = truth_[i].mode;
      out[i].link_age_s = 0.0;
    }
  }
  void order(MissionTime, std::span<const swarm::DroneOrder> orders) noexcept override {
    orders_.assign(orders.begin(), orders.end());
  }
  void advance(double dt_s) noexcept override {
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      if (orders_[i].action == swarm::Action::kLand) truth_[i].mode = swarm::VehicleMode::kGrounded;
      if (truth_[i].mode == swarm::VehicleMode::kGrounded) truth_[i].height_m = 0.0;
      truth_[i].velocity = truth_[i].mode == swarm::VehicleMode::kFlying ? orders_[i].velocity : Vec2::Zero();
      truth_[i].position += truth_[i].velocity * dt_s;
    }
  }
  [[nodiscard]] std::span<const TruthSample> truth() const noexcept override { return truth_; }
  void fail(swarm::DroneId drone) noexcept override { truth_[drone.index()].mode = swarm::VehicleMode::kFailed; }
  void take_over(swarm::DroneId drone, const Vec2&) noexcept override {
    truth_[drone.index()].mode = swarm::VehicleMode::kManual;
  }
  void give_back(swarm::DroneId drone) noexcept override { truth_[drone.index()].mode = swarm::VehicleMode::kFlying; }
  void hide(swarm::DroneId, double) noexcept override {}
  void cut_link(swarm::DroneId, double) noexcept override {}
  void befall(swarm::DroneId, const Mishap&) noexcept override {}

 private:
  std::vector<TruthSample> truth_;
  std::vector<swarm::DroneOrder> orders_;
};

inline constexpr const char* kSmallMission = R"(format: 1
name: small
field: {size_m: [3, 2], origin_m: [-1, 10]}
targets:
  clusters:
    - {name: east, points_m: [[1.2, 11.0], [1.4, 11.2]], revisit_s: 20}
  areas:
    - {name: west, outline_m: [[-0.8, 10.3], [-0.2, 10.3], [-0.2, 10.9], [-0.8, 10.9]], weight: 2}
no_fly:
  - {name: mast, outline_m: [[0.4, 11.4], [0.6, 11.4], [0.6, 11.6], [0.4, 11.6]]}
drones:
  - {id: a, start_m: [-0.5, 10.5]}
  - {id: b, start_m: [0.5, 11.0]}
  - {id: c, start_m: [1.5, 10.5]}
control: {rate_hz: 50, speed_limit_m_s: 0.3, basis_max_index: 5}
safety: {separation_m: 0.2, wall_distance_m: 0.1}
)";

/// The mission above, with more lines of YAML at its end.
[[nodiscard]] inline Mission small_mission(const std::string& more = "") {
  return parse_mission(kSmallMission + more, "the test's mission");
}

}  // namespace vigil::runtime
