#include "vigil/adapters/ros/displays.hpp"

#include <map>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include "vigil/adapters/ros/messages.hpp"
#include "vigil/adapters/ros/ros_name.hpp"

namespace vigil::ros_bridge {
namespace {

constexpr bool kLatched = true;

std::uint8_t level_of(Diagnosis::Level level) {
  using diagnostic_msgs::DiagnosticStatus;
  switch (level) {
    case Diagnosis::Level::kOk:
      return DiagnosticStatus::OK;
    case Diagnosis::Level::kWarning:
      return DiagnosticStatus::WARN;
    case Diagnosis::Level::kStale:
      return DiagnosticStatus::STALE;
    case Diagnosis::Level::kError:
      break;
  }
  return DiagnosticStatus::ERROR;
}

diagnostic_msgs::DiagnosticStatus status_of(const Diagnosis& diagnosis) {
  diagnostic_msgs::DiagnosticStatus status;
  status.name = "vigil: " + diagnosis.name;
  status.hardware_id = diagnosis.name;
  status.level = static_cast<diagnostic_msgs::DiagnosticStatus::_level_type>(level_of(diagnosis.level));
  status.message = diagnosis.summary;
  for (const auto& [key, value] : diagnosis.values) {
    diagnostic_msgs::KeyValue pair;
    pair.key = key;
    pair.value = value;
    status.values.push_back(pair);
  }
  return status;
}

}  // namespace

class Displays::Topics {
 public:
  explicit Topics(const std::vector<std::string>& drones) {
    for (const std::string& id : drones) paths_.push_back(node_.advertise<nav_msgs::Path>(ros_name(id) + "/path", 1));
  }

  void show(const DensityPicture& picture) const {
    const ros::Time now = ros::Time::now();
    density_.publish(cloud_of(picture, now));
    density_grid_.publish(grid_of(picture, now));
  }

  void show_targets(const std::vector<Mark>& marks) const {
    visualization_msgs::MarkerArray message = to_message(marks, ros::Time::now());
    visualization_msgs::Marker clear;
    clear.header.frame_id = kWorld;
    clear.action = visualization_msgs::Marker::DELETEALL;
    message.markers.insert(message.markers.begin(), clear);
    targets_.publish(message);
  }

  void show(const std::vector<Figure>& figures) {
    for (const Figure& figure : figures) {
      auto found = figures_.find(figure.name);
      if (found == figures_.end())
        found = figures_.emplace(figure.name, node_.advertise<std_msgs::Float64>(figure.name, 10)).first;
      std_msgs::Float64 message;
      message.data = figure.value;
      found->second.publish(message);
    }
  }

  void show(const std::vector<Diagnosis>& diagnoses) const {
    diagnostic_msgs::DiagnosticArray message;
    message.header.stamp = ros::Time::now();
    for (const Diagnosis& diagnosis : diagnoses) message.status.push_back(status_of(diagnosis));
    diagnostics_.publish(message);
  }

  ros::NodeHandle node_{"/vigil"};
  ros::Publisher density_ = node_.advertise<sensor_msgs::PointCloud2>("density", 1, kLatched);
  ros::Publisher density_grid_ = node_.advertise<nav_msgs::OccupancyGrid>("density_grid", 1, kLatched);
  ros::Publisher targets_ = node_.advertise<visualization_msgs::MarkerArray>("targets", 1, kLatched);
  ros::Publisher trails_ = node_.advertise<visualization_msgs::MarkerArray>("trails", 1, kLatched);
  ros::Publisher drones_ = node_.advertise<visualization_msgs::MarkerArray>("drones", 1, kLatched);
  ros::Publisher diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1);
  std::vector<ros::Publisher> paths_;
  std::map<std::string, ros::Publisher> figures_;
};

Displays::Displays(const std::vector<std::string>& drones) : topics_(std::make_unique<Topics>(drones)) {}

Displays::~Displays() = default;

void Displays::show(const DensityPicture& density) { topics_->show(density); }

void Displays::show_targets(const std::vector<Mark>& marks) { topics_->show_targets(marks); }

void Displays::show_trails(const std::vector<Mark>& marks) {
  topics_->trails_.publish(to_message(marks, ros::Time::now()));
}

void Displays::show_drones(const std::vector<Mark>& marks) {
  topics_->drones_.publish(to_message(marks, ros::Time::now()));
}

void Displays::show_path(std::size_t drone, const std::vector<Point>& places) {
  topics_->paths_.at(drone).publish(path_of(places, ros::Time::now()));
}

void Displays::show(const std::vector<Figure>& figures) { topics_->show(figures); }

void Displays::show(const std::vector<Diagnosis>& diagnoses) { topics_->show(diagnoses); }

}  // namespace vigil::ros_bridge
