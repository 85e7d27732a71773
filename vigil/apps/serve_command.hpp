#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vigil/apps/console_options.hpp"
#include "vigil/apps/recording_options.hpp"

namespace vigil::apps {

struct ServeOptions {
  std::filesystem::path mission;
  std::string fleet = "sim";
  ConsoleOptions console;
  std::filesystem::path record;  ///< empty: nothing is recorded
  RecordingOptions recording;
  std::size_t threads = 0;            ///< 0: as many as the swarm is worth
  std::filesystem::path state;        ///< empty: nothing is kept for a restart
  bool afresh = false;                ///< forget what an earlier run left
  std::vector<std::string> settings;  ///< key=value
  bool ros_tf = false;                ///< fleet "ros": positions by tf instead of vicon_bridge
  bool ros = false;                   ///< show it over ROS, and take wishes from there; always so where fleet is "ros"
  std::string ros_role = "operator";  ///< what whoever reaches the ROS master may do
};

/// `vigil serve`: flies a mission in real time and serves the console, until Ctrl-C. Throws Failure,
/// runtime::MissionError.
[[nodiscard]] int serve(const ServeOptions& options, const std::string& version);

}  // namespace vigil::apps
