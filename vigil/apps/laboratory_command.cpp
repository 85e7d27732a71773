#include "vigil/apps/laboratory_command.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/adapters/ros/session.hpp"
#include "vigil/adapters/ros/stand_in_commander.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/apps/interrupt.hpp"
#include "vigil/apps/mission_choice.hpp"
#include "vigil/apps/ros_side.hpp"
#include "vigil/apps/text_file.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::apps {
namespace {

using ros_bridge::StandInCrazyswarm;
using swarm::VehicleMode;
using Clock = std::chrono::steady_clock;

constexpr double kRateHz = 100.0;  ///< as Vicon

std::vector<std::string> ids_of(const runtime::Mission& mission) {
  std::vector<std::string> ids;
  for (const runtime::DroneEntry& drone : mission.drones) ids.push_back(drone.id);
  return ids;
}

bool is_in_the_air(const ros_bridge::StandInCommander& drone) { return drone.height_m() > 0.0; }

/// The simulated drones, obeying what comes over ROS.
class Flight {
 public:
  explicit Flight(const runtime::Mission& mission)
      : world_(runtime::world_frame(mission)),
        fleet_(simulated_fleet(mission)),
        wire_(ids_of(mission)),
        audit_(runtime::audit_limits(mission), mission.drones.size()),
        snapshot_(mission.drones.size()),
        commanders_(mission.drones.size(), ros_bridge::StandInCommander(mission.simulation.vehicle.altitude_m)),
        orders_(mission.drones.size()) {}

  void step() {
    for (std::size_t i = 0; i < orders_.size(); ++i) obey(i, wire_.take(i));
    audit_.judge(truth(), snapshot_);
    fleet_->order(runtime::MissionTime(0), orders_);
    fleet_->advance(1.0 / kRateHz);
    show();
  }

  [[nodiscard]] nlohmann::ordered_json judgement() const {
    const runtime::AuditTotals& totals = audit_.totals();
    const auto metres = [](double value) {
      return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
    };
    return {{"separation_violations", totals.separation_violations},
            {"wall_violations", totals.wall_violations},
            {"no_fly_violations", totals.no_fly_violations},
            {"speed_violations", totals.speed_violations},
            {"min_separation_m", metres(totals.least.airborne_pair_m)},
            {"min_wall_distance_m", metres(totals.least.wall_m)},
            {"max_speed_m_s", totals.max_speed_m_s},
            {"in_the_air", std::ranges::count_if(commanders_, is_in_the_air)},
            {"falls", sum(&ros_bridge::StandInCommander::falls)},
            {"starts_by_setpoints", sum(&ros_bridge::StandInCommander::starts_by_setpoints)},
            {"setpoints", setpoints_},
            {"longest_pause_s", longest_pause_s_},
            {"longest_silence_s", longest_silence_s_}};
  }

 private:
  void obey(std::size_t i, const StandInCrazyswarm::Told& told) {
    const runtime::TruthSample& truth = fleet_->truth()[i];
    swarm::DroneOrder& order = orders_[i];
    order = commanders_[i].step(told, truth.mode, truth.height_m, 1.0 / kRateHz);
    order.velocity = world_.vector_to_field(order.velocity);
    snapshot_.drones[i].order = order;
    snapshot_.drones[i].mode = truth.mode;
    snapshot_.drones[i].activity =
        truth.mode == VehicleMode::kFlying ? swarm::Activity::kActive : swarm::Activity::kGrounded;
    setpoints_ = std::max(setpoints_, told.setpoints);
    longest_pause_s_ = std::max(longest_pause_s_, told.longest_pause_s);
    longest_silence_s_ = std::max(longest_silence_s_, told.longest_silence_s);
  }

  /// Where the drones are. Velocities take them up and down as well, of which the simulated vehicles know nothing.
  std::span<const runtime::TruthSample> truth() {
    truth_.assign(fleet_->truth().begin(), fleet_->truth().end());
    for (std::size_t i = 0; i < truth_.size(); ++i) truth_[i].height_m = commanders_[i].height_m();
    return truth_;
  }

  [[nodiscard]] int sum(int (ros_bridge::StandInCommander::*count)() const) const {
    return std::accumulate(commanders_.begin(), commanders_.end(), 0,
                           [&](int so_far, const auto& one) { return so_far + (one.*count)(); });
  }

  void show() {
    std::vector<ros_bridge::Point> places;
    for (std::size_t i = 0; i < commanders_.size(); ++i) {
      const Vec2 place = world_.point_to_world(fleet_->truth()[i].position);
      places.push_back({place.x(), place.y(), commanders_[i].height_m()});
    }
    wire_.show(places);
  }

  field::WorldFrame world_;
  std::unique_ptr<runtime::VirtualFleet> fleet_;
  StandInCrazyswarm wire_;
  runtime::FlightAudit audit_;
  swarm::Snapshot snapshot_;
  std::vector<ros_bridge::StandInCommander> commanders_;
  std::vector<swarm::DroneOrder> orders_;
  std::vector<runtime::TruthSample> truth_;
  std::uint64_t setpoints_ = 0;
  double longest_pause_s_ = 0.0;
  double longest_silence_s_ = 0.0;
};

/// Vehicles do not wait for the program that flies them.
void fly(Flight& flight) {
  (void)runtime::take_real_time_priority();
  const auto step = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / kRateHz));
  auto next = Clock::now();
  while (!is_interrupted()) {
    flight.step();
    next += step;
    std::this_thread::sleep_until(next);
  }
}

void wait_for_the_end() {
  while (!is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

void check_options(const LaboratoryOptions& options) {
  if (!options.only.empty() && options.only != "crazyswarm" && options.only != "vicon")
    throw Failure(kBadInput, fmt::format("--only {}: is not known; must be: crazyswarm, vicon",
                                         runtime::on_one_line(options.only, 60)));
}

void run(const LaboratoryOptions& options, const runtime::Mission& mission) {
  const char* const node = options.only == "vicon" ? "vicon" : "laboratory";
  const ros_bridge::Session session(node, [](const std::string& text) { fmt::print(stderr, "vigil: {}\n", text); });
  std::optional<ros_bridge::StandInVicon> vicon;
  if (options.only != "crazyswarm") vicon.emplace(ids_of(mission));
  fmt::print("vigil: a laboratory of {} drones over ROS; Ctrl-C ends it\n", mission.drones.size());
  std::fflush(stdout);
  if (options.only == "vicon") return wait_for_the_end();
  Flight flight(mission);
  fly(flight);
  if (!options.out.empty()) write_whole(options.out, flight.judgement().dump(2) + "\n");
}

}  // namespace

int laboratory(const LaboratoryOptions& options) {
  check_options(options);
  runtime::Mission mission = choose_mission(options.mission, options.settings);
  check_ros_names(mission);
  mission.control.rate_hz = kRateHz;
  mission.simulation.start = runtime::StartState::kGrounded;
  catch_interrupts();
  try {
    run(options, mission);
  } catch (const ros_bridge::RosError& error) {
    throw Failure(kComponentFailed, error.what());
  }
  return kDone;
}

}  // namespace vigil::apps
