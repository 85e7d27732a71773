#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <ros/service_client.h>

#include "vigil/adapters/ros/crazyswarm_port.hpp"

/// Of the files that speak to roscpp.
namespace vigil::ros_bridge {

struct ServicesSetup {
  std::string id;
  double altitude_m = 0.5;
  double take_off_s = 2.0;
  double landing_s = 2.0;
  /// Whether Crazyswarm is there at all: before that nothing is looked up at the master.
  std::function<bool()> is_there;
  /// Told in words what did not work, on a thread of this class.
  std::function<void(const std::string&)> tell;
};

/// One drone's services of Crazyswarm: `takeoff`, `land`, `notify_setpoints_stop`. They are connected to before they
/// are needed, so that no master is, and called on a thread of this drone alone: nobody waits behind another one's. A
/// call that hangs is given up after a second.
///
/// A setpoint that comes after notify_setpoints_stop takes the drone back, and a drone without any levels after half a
/// second. So a landing first asks for notify_setpoints_stop while setpoints go on, to see whether anybody answers, and
/// then holds them for as long as it takes to ask for it again and to land, but for no longer than kHeldForS.
class DroneServices {
 public:
  explicit DroneServices(ServicesSetup setup);
  /// Ends calls that hang.
  ~DroneServices();
  DroneServices(const DroneServices&) = delete;
  DroneServices& operator=(const DroneServices&) = delete;

  // The control thread's: they never wait.
  /// The newest call takes the place of one that has not begun. False where it could not be passed on now.
  [[nodiscard]] bool ask(VehicleCall call) noexcept;
  [[nodiscard]] Answer answer() const noexcept { return answer_; }

  /// Whether no setpoint may be sent now: the drone is being handed over to Crazyswarm, or was. Any thread.
  [[nodiscard]] bool holds_setpoints() const noexcept;

  /// To be called some ten times a second, by any one thread.
  void give_up_late_calls();
  /// Nothing new begins; the destructor does not wait for this first.
  void stop() noexcept;

  static constexpr auto kLongestCall = std::chrono::seconds(1);
  static constexpr auto kHeldFor = std::chrono::milliseconds(400);

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  [[nodiscard]] std::optional<VehicleCall> next();
  void connect();
  void make(VehicleCall call);
  [[nodiscard]] bool take_off();
  [[nodiscard]] bool land();
  [[nodiscard]] bool let_go();
  template <typename Request>
  [[nodiscard]] bool is_connected(ros::ServiceClient& client, const char* service);
  template <typename Request>
  [[nodiscard]] bool call(ros::ServiceClient& client, const char* service, const Request& request);
  [[nodiscard]] bool begin(const ros::ServiceClient& client);
  void drop_call(Clock::duration older_than);

  ServicesSetup setup_;
  std::atomic<bool> is_over_{false};
  std::atomic<bool> has_ended_{false};
  std::atomic<Answer> answer_{Answer::kNo};
  std::atomic<bool> is_handed_over_{false};
  std::atomic<Clock::rep> held_until_{0};

  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<VehicleCall> wanted_;
  ros::ServiceClient calling_;  ///< that waits for an answer just now
  Clock::time_point called_at_;

  ros::ServiceClient take_off_;  // the thread's
  ros::ServiceClient land_;
  ros::ServiceClient let_go_;
  std::thread thread_;
};

}  // namespace vigil::ros_bridge
