#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/ros/scene.hpp"

namespace vigil::ros_bridge {

/// What RViz, rqt_plot and other ROS tools see. One thread. Every topic begins with /vigil, but /diagnostics:
///
///     density                 sensor_msgs/PointCloud2     red, opaque where the density is highest (latched)
///     density_grid            nav_msgs/OccupancyGrid      the same in percent of the highest (latched)
///     targets, trails, drones visualization_msgs/MarkerArray
///     <drone>/path            nav_msgs/Path
///     <figure>                std_msgs/Float64
///     /diagnostics            diagnostic_msgs/DiagnosticArray
///
/// Drones whose id is no ROS name (letters, digits, _) get one that is: see ros_name.hpp.
class Displays {
 public:
  explicit Displays(const std::vector<std::string>& drones);
  ~Displays();
  Displays(const Displays&) = delete;
  Displays& operator=(const Displays&) = delete;

  void show(const DensityPicture& density);
  void show_targets(const std::vector<Mark>& marks);  ///< replaces all that was shown there
  void show_trails(const std::vector<Mark>& marks);
  void show_drones(const std::vector<Mark>& marks);
  void show_path(std::size_t drone, const std::vector<Point>& places);
  void show(const std::vector<Figure>& figures);
  void show(const std::vector<Diagnosis>& diagnoses);

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace vigil::ros_bridge
