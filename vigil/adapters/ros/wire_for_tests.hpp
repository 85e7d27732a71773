#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vigil/adapters/ros/crazyswarm_port.hpp"

namespace vigil::ros_bridge {

/// Drones that are where they are put, in time that a test turns.
class Wire final : public CrazyswarmPort {
 public:
  explicit Wire(std::size_t drones) : sightings(drones), setpoints(drones) {}

  [[nodiscard]] double now_s() const noexcept override { return time_s; }
  [[nodiscard]] Sighting newest(std::size_t drone) noexcept override { return sightings[drone]; }
  [[nodiscard]] bool is_connected(std::size_t /*drone*/) noexcept override { return connected; }
  void set(std::size_t drone, const Setpoint& setpoint) noexcept override { setpoints[drone] = setpoint; }
  void flush() noexcept override { ++flushes; }
  [[nodiscard]] bool call(std::size_t drone, VehicleCall call) noexcept override {
    calls.emplace_back(drone, call);
    return true;
  }
  [[nodiscard]] Answer answer(std::size_t /*drone*/) noexcept override { return answers; }

  [[nodiscard]] bool tell_mistaken(std::size_t drone, std::size_t other) noexcept override {
    told.emplace_back(drone, other);
    return true;
  }

  [[nodiscard]] bool tell_refused(std::size_t drone, const char* why) noexcept override {
    refused.emplace_back(drone, why == nullptr ? "" : why);
    return true;
  }

  void see(std::size_t drone, Point place) {
    place.z += 1e-6 * static_cast<double>(sightings[drone].number % 2);  // no tracker sees the same twice
    sightings[drone] = {place, time_s, time_s, sightings[drone].number + 1};
  }

  double time_s = 100.0;
  bool connected = true;
  Answer answers = Answer::kYes;  ///< to every call
  int flushes = 0;
  std::vector<Sighting> sightings;
  std::vector<Setpoint> setpoints;
  std::vector<std::pair<std::size_t, VehicleCall>> calls;
  std::vector<std::pair<std::size_t, std::string>> refused;  ///< and why; empty: no longer
  std::vector<std::pair<std::size_t, std::size_t>> told;     ///< who is taken for whom
};

}  // namespace vigil::ros_bridge
