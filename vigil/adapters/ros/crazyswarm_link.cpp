#include "vigil/adapters/ros/crazyswarm_link.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include "vigil/adapters/ros/crazyswarm_messages.hpp"
#include "vigil/adapters/ros/drone_services.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kStreamEvery = 20ms;
constexpr std::size_t kMostErrands = 256;
constexpr int kStops = 5;  ///< so often motors are told to stop: a setpoint on its way may arrive after the first

std::string without_slash(const std::string& frame) { return frame.rfind('/', 0) == 0 ? frame.substr(1) : frame; }

double steady_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

/// The newest position of each drone, from ROS' threads to the control thread, which never waits.
class Sightings {
 public:
  explicit Sightings(std::size_t drones) : newest_(drones), taken_(drones) {}

  void add(std::size_t drone, const geometry_msgs::TransformStamped& seen) {
    const geometry_msgs::Vector3& place = seen.transform.translation;
    const double now_s = steady_s();
    const double measured_s = measured_at(now_s, ros::Time::now().toSec(), seen.header.stamp.toSec());
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::uint64_t number = newest_[drone].number + 1;
    newest_[drone] = {{place.x, place.y, place.z}, measured_s, now_s, number};
  }

  Sighting take(std::size_t drone) noexcept {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) taken_[drone] = newest_[drone];
    return taken_[drone];
  }

 private:
  std::mutex mutex_;
  std::vector<Sighting> newest_;
  std::vector<Sighting> taken_;  // the control thread's
};

class CrazyswarmLink final : public CrazyswarmPort {
 public:
  explicit CrazyswarmLink(const CrazyswarmSetup& setup)
      : setup_(setup),
        sightings_(setup.drones.size()),
        mine_(setup.drones.size()),
        set_(setup.drones.size()),
        connected_(setup.drones.size()),
        stops_left_(setup.drones.size()) {
    node_.setCallbackQueue(&queue_);
    for (std::size_t i = 0; i < setup_.drones.size(); ++i) {
      const std::string& id = setup_.drones[i];
      services_.push_back(
          std::make_unique<DroneServices>(ServicesSetup{id, setup_.altitude_m, setup_.take_off_s, setup_.landing_s,
                                                        [this, i] { return connected_[i].load(); }, setup_.tell}));
      velocities_.push_back(node_.advertise<crazyswarm::VelocityWorld>(ros_name(id) + "/cmd_velocity_world", 1));
      stops_.push_back(node_.advertise<std_msgs::Empty>(ros_name(id) + "/cmd_stop", 1));
    }
    listen();
    runtime::start_with_real_time_priority([this] { spinner_.start(); });
    streamer_ = std::thread([this] { stream(); });
    caller_ = std::thread([this] { run_errands(); });
  }

  ~CrazyswarmLink() override {
    is_over_ = true;
    wake_streamer_.notify_one();
    wake_caller_.notify_one();
    streamer_.join();
    caller_.join();
    for (const std::unique_ptr<DroneServices>& services : services_) services->stop();
    services_.clear();
    spinner_.stop();
    queue_.disable();
  }

  CrazyswarmLink(const CrazyswarmLink&) = delete;
  CrazyswarmLink& operator=(const CrazyswarmLink&) = delete;

  [[nodiscard]] double now_s() const noexcept override { return steady_s(); }
  [[nodiscard]] Sighting newest(std::size_t drone) noexcept override { return sightings_.take(drone); }
  [[nodiscard]] bool is_connected(std::size_t drone) noexcept override { return connected_[drone]; }
  void set(std::size_t drone, const Setpoint& setpoint) noexcept override { mine_[drone] = setpoint; }

  void flush() noexcept override {
    {
      const std::unique_lock<std::mutex> lock(set_mutex_, std::try_to_lock);
      if (!lock.owns_lock()) return;  // the streamer copies just now; it gets this with the next tick's
      set_ = mine_;
      set_at_ = Clock::now();
      is_new_ = true;
    }
    wake_streamer_.notify_one();
  }

  [[nodiscard]] bool call(std::size_t drone, VehicleCall call) noexcept override {
    if (call != VehicleCall::kEmergency) return services_[drone]->ask(call);
    stops_left_[drone] = kStops;  // the streamer sends them, behind nobody's service
    return true;
  }

  [[nodiscard]] Answer answer(std::size_t drone) noexcept override { return services_[drone]->answer(); }

  [[nodiscard]] bool tell_mistaken(std::size_t drone, std::size_t other) noexcept override {
    return queue({drone, other, nullptr, true});
  }

  [[nodiscard]] bool tell_refused(std::size_t drone, const char* why) noexcept override {
    return queue({drone, drone, why, false});
  }

 private:
  /// Operators are told for whom a drone is taken: on a thread that may wait.
  struct Errand {
    std::size_t drone = 0;
    std::size_t mistaken_for = 0;
    const char* why_refused = nullptr;  ///< null: positions are used again
    bool is_mistaken = false;           ///< otherwise positions are refused, or used again
  };

  [[nodiscard]] bool queue(const Errand& errand) noexcept {
    {
      const std::unique_lock<std::mutex> lock(errands_mutex_, std::try_to_lock);
      if (!lock.owns_lock() || errands_.size() >= kMostErrands) return false;
      errands_.push_back(errand);
    }
    wake_caller_.notify_one();
    return true;
  }

  void listen() {
    const ros::TransportHints at_once = ros::TransportHints().tcpNoDelay();
    if (setup_.positions_by_tf) {
      positions_.push_back(node_.subscribe<tf2_msgs::TFMessage>(
          "/tf", 100, [this](const tf2_msgs::TFMessage::ConstPtr& seen) { take(*seen); }, ros::VoidConstPtr(),
          at_once));
      return;
    }
    for (std::size_t i = 0; i < setup_.drones.size(); ++i) {
      positions_.push_back(node_.subscribe<geometry_msgs::TransformStamped>(
          vicon_topic(setup_.drones[i]), 1,
          [this, i](const geometry_msgs::TransformStamped::ConstPtr& seen) { take(i, *seen); }, ros::VoidConstPtr(),
          at_once));
    }
  }

  void take(std::size_t drone, const geometry_msgs::TransformStamped& seen) {
    const std::string& id = setup_.drones[drone];
    const std::string complaint = complaint_of_frames(id, seen.header.frame_id, seen.child_frame_id);
    if (complaint.empty()) return sightings_.add(drone, seen);
    if (complained_of_.insert(drone).second) setup_.tell(id + ": not used: " + complaint);
  }

  void take(const tf2_msgs::TFMessage& seen) {
    for (const geometry_msgs::TransformStamped& one : seen.transforms) {
      if (without_slash(one.header.frame_id) != "world") continue;
      const std::string child = without_slash(one.child_frame_id);
      for (std::size_t i = 0; i < setup_.drones.size(); ++i)
        if (child == ros_name(setup_.drones[i])) sightings_.add(i, one);
    }
  }

  void stream() {
    (void)runtime::take_real_time_priority();  // elsewhere it takes its turn
    std::vector<Setpoint> setpoints(setup_.drones.size());
    auto next = Clock::now();
    while (!is_over_) {
      Clock::time_point set_at;
      {
        std::unique_lock<std::mutex> lock(set_mutex_);
        wake_streamer_.wait_until(lock, next, [this] { return is_new_ || is_over_; });
        is_new_ = false;
        setpoints = set_;
        set_at = set_at_;
      }
      next = Clock::now() + kStreamEvery;
      send(setpoints, std::chrono::duration<double>(Clock::now() - set_at).count() <= kStandsForS);
    }
  }

  void send(const std::vector<Setpoint>& setpoints, bool stand) {
    crazyswarm::VelocityWorld message;
    message.header.frame_id = "world";
    message.header.stamp = ros::Time::now();
    for (std::size_t i = 0; i < setpoints.size(); ++i) {
      connected_[i] = velocities_[i].getNumSubscribers() > 0;
      if (stops(i, setpoints[i].is_streamed) || !setpoints[i].is_streamed || services_[i]->holds_setpoints()) continue;
      const Point velocity = stand ? setpoints[i].velocity_m_s : Point{};
      message.vel.x = velocity.x;
      message.vel.y = velocity.y;
      message.vel.z = velocity.z;
      velocities_[i].publish(message);
    }
  }

  /// Whether the drone's motors are told to stop, and it gets no setpoint, which would start them again: until a few
  /// were sent after the control thread had ended its stream.
  bool stops(std::size_t drone, bool is_streamed) {
    if (stops_left_[drone] == 0) return false;
    stops_[drone].publish(std_msgs::Empty());
    if (!is_streamed) --stops_left_[drone];
    return true;
  }

  void run_errands() {
    while (!is_over_) {
      if (const std::optional<Errand> errand = next_errand()) run(*errand);
      for (const std::unique_ptr<DroneServices>& services : services_) services->give_up_late_calls();
    }
  }

  std::optional<Errand> next_errand() {
    std::unique_lock<std::mutex> lock(errands_mutex_);
    wake_caller_.wait_for(lock, 100ms, [this] { return !errands_.empty() || is_over_; });
    if (errands_.empty()) return std::nullopt;
    const Errand errand = errands_.front();
    errands_.pop_front();
    return errand;
  }

  void run(const Errand& errand) {
    const std::string& id = setup_.drones[errand.drone];
    if (!errand.is_mistaken && errand.why_refused == nullptr) return setup_.tell(id + ": positions are used again");
    if (!errand.is_mistaken) return setup_.tell(id + ": positions come and are not used: " + errand.why_refused);
    setup_.tell(id + " and " + setup_.drones[errand.mistaken_for] +
                ": the tracker takes one for the other; who was mistaken hovers until it is seen in its own place, and "
                "lands after five seconds");
  }

  CrazyswarmSetup setup_;
  Sightings sightings_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"/"};
  std::vector<ros::Subscriber> positions_;
  std::set<std::size_t> complained_of_;  ///< drones whose positions are of another frame; the spinner's
  std::vector<ros::Publisher> velocities_;
  std::vector<ros::Publisher> stops_;
  ros::AsyncSpinner spinner_{1, &queue_};
  std::atomic<bool> is_over_{false};

  std::vector<Setpoint> mine_;  // the control thread's
  std::mutex set_mutex_;
  std::condition_variable wake_streamer_;
  std::vector<Setpoint> set_;
  Clock::time_point set_at_{};
  bool is_new_ = false;
  std::vector<std::atomic<bool>> connected_;
  std::vector<std::atomic<int>> stops_left_;
  std::vector<std::unique_ptr<DroneServices>> services_;
  std::thread streamer_;

  std::mutex errands_mutex_;
  std::condition_variable wake_caller_;
  std::deque<Errand> errands_;
  std::thread caller_;
};

}  // namespace

std::unique_ptr<CrazyswarmPort> link_to_crazyswarm(const CrazyswarmSetup& setup) {
  return std::make_unique<CrazyswarmLink>(setup);
}

}  // namespace vigil::ros_bridge
