#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/runtime/recorder.hpp"

/// A flight made by hand, for the tests of writer and reader.
namespace vigil::recording {

/// A folder that is empty when the test begins and gone when it ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vigil-recording-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / "out" / name; }

 private:
  std::filesystem::path path_;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void overwrite(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

inline runtime::Mission mission_of(std::size_t drones) {
  runtime::Mission mission;
  mission.field.size_m = {3.0, 3.0};
  mission.field.origin_m = {-1.5, -1.5};
  mission.field.yaw_rad = 0.1;
  mission.control.speed_limit_m_s = 0.3;
  mission.safety.barrier = safety::BarrierKind::kPaper;
  mission.safety.separation_m = 0.2;
  mission.safety.wall_distance_m = 0.1;
  for (std::size_t i = 0; i < drones; ++i) mission.drones.push_back({"cf" + std::to_string(i + 1), Vec2::Zero()});
  mission.targets.clusters.push_back({"east, \"far\"", {{0.7, 0.25}, {0.9, 0.45}}, 2.0, {}});
  mission.targets.areas.push_back({"pond", {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}, 5.0, 0.0, {}});
  return mission;
}

inline swarm::Snapshot snapshot_at(std::size_t tick, std::size_t drones) {
  swarm::Snapshot s(drones);
  s.tick = tick;
  s.time_s = 0.02 * static_cast<double>(tick);
  s.has_metric = tick > 0;
  s.metric = 0.1 / (1.0 + s.time_s);
  s.metric_percent = 100.0 / (1.0 + s.time_s);
  s.active = drones;
  for (std::size_t i = 0; i < drones; ++i) {
    swarm::DroneSnapshot& d = s.drones[i];
    const double phase = s.time_s + static_cast<double>(i);
    d.position = {1.5 + std::cos(phase), 1.5 + std::sin(phase)};
    d.velocity = {-std::sin(phase), std::cos(phase)};
    d.height_m = 0.5;
    d.mode = swarm::VehicleMode::kFlying;
    d.activity = swarm::Activity::kActive;
    d.u_nom = 0.3 * d.velocity;
    d.order = {swarm::Action::kVelocity, 0.2 * d.velocity};
  }
  return s;
}

inline std::vector<runtime::TruthSample> truth_of(const swarm::Snapshot& snapshot) {
  std::vector<runtime::TruthSample> truth;
  for (const swarm::DroneSnapshot& d : snapshot.drones) {
    truth.push_back({d.position + Vec2(0.01, 0.0), d.velocity, d.height_m, d.mode});
  }
  return truth;
}

inline std::vector<swarm::DroneObservation> observations_of(const swarm::Snapshot& snapshot) {
  std::vector<swarm::DroneObservation> observations;
  for (const swarm::DroneSnapshot& d : snapshot.drones) {
    observations.push_back({.position = d.position,
                            .velocity = d.velocity,
                            .height_m = d.height_m,
                            .age_s = 0.0,
                            .mode = d.mode,
                            .link_age_s = 0.0,
                            .battery = 0.9});
  }
  return observations;
}

inline void record(runtime::Recorder& recorder, const swarm::Snapshot& snapshot) {
  const std::vector<runtime::TruthSample> truth = truth_of(snapshot);
  recorder.record({snapshot,
                   observations_of(snapshot),
                   {},
                   truth,
                   {.airborne_pair_m = 0.5 + snapshot.time_s, .active_pair_m = 0.6, .wall_m = 0.4}});
}

/// Records so many ticks with two lists of targets and two events.
inline void record_flight(runtime::Recorder& recorder, std::size_t ticks, std::size_t drones) {
  const runtime::Mission mission = mission_of(drones);
  recorder.begin(mission, {});
  recorder.targets(0.0, runtime::targets_of(mission));
  recorder.log({0.0, "mission", "begin", "", "said \"go\",\nand went"});
  for (std::size_t tick = 0; tick < ticks; ++tick) record(recorder, snapshot_at(tick, drones));
  recorder.targets(0.5, {});
  recorder.log({0.5, "operator", "land", "cf2", ""});
  recorder.finish();
}

}  // namespace vigil::recording
