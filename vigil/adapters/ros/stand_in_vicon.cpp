#include <deque>
#include <map>
#include <random>
#include <sstream>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

constexpr double kNoiseM = 1e-4;
constexpr double kLongestDelayS = 5.0;
constexpr unsigned kSeed = 1;

using Bodies = tf2_msgs::TFMessage;

}  // namespace

class StandInVicon::Wire {
 public:
  explicit Wire(const std::vector<std::string>& drones) {
    node_.setCallbackQueue(&queue_);
    for (const std::string& id : drones)
      subjects_[ros_name(id)] = node_.advertise<geometry_msgs::TransformStamped>(vicon_topic(id), 10);
    bodies_ = node_.subscribe("/laboratory/bodies", 1, &Wire::see, this, ros::TransportHints().tcpNoDelay());
    faults_ = node_.subscribe("/laboratory/fault", 10, &Wire::spoil, this);
    runtime::start_with_real_time_priority([this] { spinner_.start(); });
  }

  ~Wire() {
    spinner_.stop();
    queue_.disable();
  }

  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

 private:
  void see(const Bodies& bodies) {
    Bodies seen = bodies;
    for (geometry_msgs::TransformStamped& body : seen.transforms) add_noise(body.transform.translation);
    if (is_frozen_ && !last_.transforms.empty()) repeat(last_, seen);
    last_ = seen;
    waiting_.push_back(seen);
    const ros::Time now = ros::Time::now();
    while (!waiting_.empty() && !waiting_.front().transforms.empty() &&
           (now - waiting_.front().transforms.front().header.stamp).toSec() >= delay_s_) {
      publish(waiting_.front());
      waiting_.pop_front();
    }
  }

  void add_noise(geometry_msgs::Vector3& place) {
    place.x += noise_(random_);
    place.y += noise_(random_);
    place.z += noise_(random_);
  }

  /// The old places under new stamps.
  static void repeat(const Bodies& old, Bodies& now) {
    for (std::size_t i = 0; i < now.transforms.size() && i < old.transforms.size(); ++i)
      now.transforms[i].transform = old.transforms[i].transform;
  }

  void publish(const Bodies& bodies) {
    Bodies seen = bodies;
    for (geometry_msgs::TransformStamped& body : seen.transforms) {
      if (body.child_frame_id == swapped_.first)
        body.child_frame_id = swapped_.second;
      else if (body.child_frame_id == swapped_.second)
        body.child_frame_id = swapped_.first;
      const auto subject = subjects_.find(body.child_frame_id);
      if (subject != subjects_.end()) subject->second.publish(body);
    }
    tf_.publish(seen);
  }

  void spoil(const std_msgs::String& fault) {
    std::istringstream words(fault.data);
    std::string what;
    words >> what;
    is_frozen_ = what == "freeze";
    delay_s_ = 0.0;
    swapped_ = {};
    if (what == "delay" && (!(words >> delay_s_) || !(delay_s_ >= 0.0 && delay_s_ <= kLongestDelayS))) delay_s_ = 0.0;
    if (what == "swap") words >> swapped_.first >> swapped_.second;
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"/"};
  std::map<std::string, ros::Publisher> subjects_;
  ros::Publisher tf_ = node_.advertise<Bodies>("/tf", 10);
  ros::Subscriber bodies_;
  ros::Subscriber faults_;
  std::mt19937 random_{kSeed};
  std::normal_distribution<double> noise_{0.0, kNoiseM};
  Bodies last_;
  std::deque<Bodies> waiting_;
  bool is_frozen_ = false;
  double delay_s_ = 0.0;
  std::pair<std::string, std::string> swapped_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

StandInVicon::StandInVicon(const std::vector<std::string>& drones) : wire_(std::make_unique<Wire>(drones)) {}

StandInVicon::~StandInVicon() = default;

}  // namespace vigil::ros_bridge
