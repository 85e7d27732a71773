#include <algorithm>
#include <mutex>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include "vigil/adapters/ros/crazyswarm_messages.hpp"
#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/adapters/ros/registry.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

constexpr double kSetpointStandsForS = 0.5;
/// All that come are looked at: one that was overwritten here would look like one that was not sent.
constexpr std::uint32_t kSetpointsThatWait = 100;

}  // namespace

class StandInCrazyswarm::Wire {
 public:
  explicit Wire(const std::vector<std::string>& drones) : drones_(drones.size()) {
    node_.setCallbackQueue(&queue_);
    for (std::size_t i = 0; i < drones.size(); ++i) {
      names_.push_back(ros_name(drones[i]));
      listen(i);
    }
    runtime::start_with_real_time_priority([this] { spinner_.start(); });
  }

  ~Wire() {
    spinner_.stop();
    queue_.disable();
  }

  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  Told take(std::size_t drone) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Drone& mine = drones_[drone];
    Told told = mine.told;
    told.has_setpoint = told.setpoints > 0 && ros::Time::now().toSec() - mine.last_s < kSetpointStandsForS;
    mine.told.take_off = mine.told.land = mine.told.stop_motors = false;
    return told;
  }

  void show(const std::vector<Point>& places) const {
    tf2_msgs::TFMessage message;
    for (std::size_t i = 0; i < places.size(); ++i) {
      geometry_msgs::TransformStamped body;
      body.header.stamp = ros::Time::now();
      body.header.frame_id = "world";
      body.child_frame_id = names_[i];
      body.transform.translation.x = places[i].x;
      body.transform.translation.y = places[i].y;
      body.transform.translation.z = places[i].z;
      body.transform.rotation.w = 1.0;
      message.transforms.push_back(body);
    }
    bodies_.publish(message);
  }

 private:
  struct Drone {
    Told told;
    double last_s = 0.0;  ///< when the last setpoint came; 0 after a landing
    double sent_s = 0.0;  ///< and when it was sent, by its stamp
  };

  void listen(std::size_t i) {
    inputs_.push_back(node_.subscribe<crazyswarm::VelocityWorld>(
        "/" + names_[i] + "/cmd_velocity_world", kSetpointsThatWait,
        [this, i](const boost::shared_ptr<crazyswarm::VelocityWorld const>& message) { take(i, *message); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    serve<crazyswarm::TakeoffRequest>(i, "takeoff", [](Told& told) { told.take_off = true; });
    serve<crazyswarm::LandRequest>(i, "land", [](Told& told) { told.land = true; });
    serve<crazyswarm::NotifySetpointsStopRequest>(i, "notify_setpoints_stop", [](Told&) {});
    inputs_.push_back(node_.subscribe<std_msgs::Empty>(
        "/" + names_[i] + "/cmd_stop", 1,
        [this, i](const std_msgs::Empty::ConstPtr&) { note(i, [](Told& told) { told.stop_motors = true; }); }));
  }

  template <typename Request, typename Work>
  void serve(std::size_t i, const char* name, Work work) {
    using Response = crazyswarm::EmptyResponse<Request>;
    keep(node_.advertiseService<Request, Response>("/" + names_[i] + "/" + name, [this, i, work](Request&, Response&) {
      note(i, work);
      return true;
    }));
  }

  void keep(const ros::ServiceServer& service) {
    services_.push_back(service);
    note_service(service.getService());
  }

  template <typename Work>
  void note(std::size_t drone, Work work) {
    const std::lock_guard<std::mutex> lock(mutex_);
    work(drones_[drone].told);
    if (drones_[drone].told.land || drones_[drone].told.stop_motors) drones_[drone].last_s = 0.0;
  }

  void take(std::size_t drone, const crazyswarm::VelocityWorld& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Drone& mine = drones_[drone];
    const double now_s = ros::Time::now().toSec();
    const double sent_s = message.header.stamp.toSec();
    // A stream that was ended by a landing begins anew.
    if (mine.last_s > 0.0) {
      mine.told.longest_pause_s = std::max(mine.told.longest_pause_s, sent_s - mine.sent_s);
      mine.told.longest_silence_s = std::max(mine.told.longest_silence_s, now_s - mine.last_s);
    }
    mine.last_s = now_s;
    mine.sent_s = sent_s;
    ++mine.told.setpoints;
    mine.told.velocity_m_s = {message.vel.x, message.vel.y, message.vel.z};
  }

  std::vector<std::string> names_;
  std::mutex mutex_;
  std::vector<Drone> drones_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"/"};
  ros::Publisher bodies_ = node_.advertise<tf2_msgs::TFMessage>("/laboratory/bodies", 1);
  std::vector<ros::Subscriber> inputs_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

StandInCrazyswarm::StandInCrazyswarm(const std::vector<std::string>& drones) : wire_(std::make_unique<Wire>(drones)) {}

StandInCrazyswarm::~StandInCrazyswarm() = default;

StandInCrazyswarm::Told StandInCrazyswarm::take(std::size_t drone) { return wire_->take(drone); }

void StandInCrazyswarm::show(const std::vector<Point>& places) { wire_->show(places); }

}  // namespace vigil::ros_bridge
