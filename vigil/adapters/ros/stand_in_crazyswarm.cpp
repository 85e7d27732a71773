#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <sstream>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include "vigil/adapters/ros/crazyswarm_messages.hpp"
#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/adapters/ros/registry.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

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
    faults_ = node_.subscribe("/laboratory/fault", 10, &Wire::spoil, this);
    runtime::start_with_real_time_priority([this] { spinner_.start(); });
  }

  ~Wire() {
    hang("");
    desks_.clear();
    spinner_.stop();
    queue_.disable();
  }

  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  Told take(std::size_t drone) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Drone& mine = drones_[drone];
    Told told = mine.told;
    if (told.follows_setpoints) told.silence_s = ros::Time::now().toSec() - mine.last_s;
    told.longest_silence_s = std::max(told.longest_silence_s, told.silence_s);
    mine.told.longest_silence_s = told.longest_silence_s;
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
    double last_s = 0.0;  ///< when the last setpoint came
    double sent_s = 0.0;  ///< and when it was sent, by its stamp
  };

  /// Where one drone's services are answered: those of one may hang, and the others' must not wait for it.
  struct Desk {
    Desk() {
      runtime::start_with_real_time_priority([this] { spinner.start(); }, runtime::Urgency::kBeforeOthers);
    }
    ~Desk() {
      spinner.stop();
      services.clear();
      queue.disable();
    }
    Desk(const Desk&) = delete;
    Desk& operator=(const Desk&) = delete;

    ros::CallbackQueue queue;
    std::vector<ros::ServiceServer> services;
    ros::AsyncSpinner spinner{1, &queue};
  };

  void listen(std::size_t i) {
    desks_.push_back(std::make_unique<Desk>());
    inputs_.push_back(node_.subscribe<crazyswarm::VelocityWorld>(
        "/" + names_[i] + "/cmd_velocity_world", kSetpointsThatWait,
        [this, i](const boost::shared_ptr<crazyswarm::VelocityWorld const>& message) { take(i, *message); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
    serve<crazyswarm::TakeoffRequest>(i, "takeoff", [](Told& told) { told.take_off = !told.follows_setpoints; });
    serve<crazyswarm::LandRequest>(i, "land", [](Told& told) { told.land = !told.follows_setpoints; });
    serve<crazyswarm::NotifySetpointsStopRequest>(i, "notify_setpoints_stop",
                                                  [](Told& told) { told.follows_setpoints = false; });
    inputs_.push_back(
        node_.subscribe<std_msgs::Empty>("/" + names_[i] + "/cmd_stop", 1, [this, i](const std_msgs::Empty::ConstPtr&) {
          note(i, [](Told& told) {
            told.stop_motors = true;
            told.follows_setpoints = false;
          });
        }));
  }

  template <typename Request, typename Work>
  void serve(std::size_t i, const char* name, Work work) {
    using Response = crazyswarm::EmptyResponse<Request>;
    ros::AdvertiseServiceOptions service;
    service.init<Request, Response>("/" + names_[i] + "/" + name, [this, i, work](Request&, Response&) {
      wait_while_it_hangs(i);
      note(i, work);
      return true;
    });
    service.callback_queue = &desks_[i]->queue;
    desks_[i]->services.push_back(node_.advertiseService(service));
    note_service(desks_[i]->services.back().getService());
  }

  template <typename Work>
  void note(std::size_t drone, Work work) {
    const std::lock_guard<std::mutex> lock(mutex_);
    work(drones_[drone].told);
  }

  void wait_while_it_hangs(std::size_t drone) {
    std::unique_lock<std::mutex> lock(mutex_);
    answers_.wait(lock, [&] { return hanging_ != names_[drone]; });
  }

  void spoil(const std_msgs::String& fault) {
    std::istringstream words(fault.data);
    std::string what;
    std::string drone;
    words >> what >> drone;
    hang(what == "hang" ? drone : "");
  }

  void hang(const std::string& drone) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      hanging_ = drone;
    }
    answers_.notify_all();
  }

  void take(std::size_t drone, const crazyswarm::VelocityWorld& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Drone& mine = drones_[drone];
    const double now_s = ros::Time::now().toSec();
    const double sent_s = message.header.stamp.toSec();
    // A stream that was let go of begins anew.
    if (mine.told.follows_setpoints) {
      mine.told.longest_pause_s = std::max(mine.told.longest_pause_s, sent_s - mine.sent_s);
      mine.told.longest_silence_s = std::max(mine.told.longest_silence_s, now_s - mine.last_s);
    }
    mine.last_s = now_s;
    mine.sent_s = sent_s;
    ++mine.told.setpoints;
    mine.told.follows_setpoints = true;
    mine.told.velocity_m_s = {message.vel.x, message.vel.y, message.vel.z};
  }

  std::vector<std::string> names_;
  std::mutex mutex_;
  std::vector<Drone> drones_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"/"};
  ros::Publisher bodies_ = node_.advertise<tf2_msgs::TFMessage>("/laboratory/bodies", 1);
  std::vector<ros::Subscriber> inputs_;
  ros::AsyncSpinner spinner_{1, &queue_};

  std::vector<std::unique_ptr<Desk>> desks_;
  std::condition_variable answers_;
  std::string hanging_;  ///< whose services do not answer
  ros::Subscriber faults_;
};

StandInCrazyswarm::StandInCrazyswarm(const std::vector<std::string>& drones) : wire_(std::make_unique<Wire>(drones)) {}

StandInCrazyswarm::~StandInCrazyswarm() = default;

StandInCrazyswarm::Told StandInCrazyswarm::take(std::size_t drone) { return wire_->take(drone); }

void StandInCrazyswarm::show(const std::vector<Point>& places) { wire_->show(places); }

}  // namespace vigil::ros_bridge
