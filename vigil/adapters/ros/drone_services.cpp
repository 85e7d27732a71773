#include "vigil/adapters/ros/drone_services.hpp"

#include <utility>

#include <ros/node_handle.h>

#include "vigil/adapters/ros/crazyswarm_messages.hpp"
#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

using namespace std::chrono_literals;

constexpr auto kConnectEvery = 1s;
/// A setpoint that was sent before has arrived after so long: topics and services overtake each other.
constexpr auto kOnTheWay = 100ms;
/// Setpoints may begin again a moment before the hold is seen to be over.
constexpr auto kMargin = 50ms;

template <typename Request>
Request height_request(double height_m, double duration_s) {
  Request request;
  request.height = static_cast<float>(height_m);
  request.duration = ros::Duration(duration_s);
  return request;
}

}  // namespace

DroneServices::DroneServices(ServicesSetup setup) : setup_(std::move(setup)), thread_([this] { run(); }) {}

DroneServices::~DroneServices() {
  stop();
  while (!has_ended_) {
    drop_call(100ms);
    std::this_thread::sleep_for(5ms);
  }
  thread_.join();
}

void DroneServices::stop() noexcept {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  wake_.notify_one();
}

bool DroneServices::ask(VehicleCall call) noexcept {
  {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock()) return false;
    wanted_ = call;
    answer_ = Answer::kWaiting;
    is_handed_over_ = false;
  }
  wake_.notify_one();
  return true;
}

bool DroneServices::holds_setpoints() const noexcept {
  return is_handed_over_ || Clock::now().time_since_epoch().count() < held_until_;
}

void DroneServices::give_up_late_calls() { drop_call(kLongestCall); }

void DroneServices::drop_call(Clock::duration older_than) {
  ros::ServiceClient hung;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (calling_ && Clock::now() - called_at_ > older_than) hung = calling_;
  }
  hung.shutdown();  // of the connection: whoever waits for an answer on it is told that there will be none
}

void DroneServices::run() {
  // While a call is being written or read here, roscpp's own thread asks for its lock again and again, and lets nobody
  // run who is not before it.
  (void)runtime::take_real_time_priority(runtime::Urgency::kBeforeOthers);
  while (!is_over_) {
    if (const std::optional<VehicleCall> call = next())
      make(*call);
    else if (setup_.is_there())
      connect();
  }
  has_ended_ = true;
}

std::optional<VehicleCall> DroneServices::next() {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait_for(lock, kConnectEvery, [this] { return wanted_ || is_over_; });
  return is_over_ ? std::nullopt : std::exchange(wanted_, std::nullopt);
}

/// What a landing needs first.
void DroneServices::connect() {
  if (!is_connected<crazyswarm::NotifySetpointsStopRequest>(let_go_, "notify_setpoints_stop")) return;
  if (!is_connected<crazyswarm::LandRequest>(land_, "land")) return;
  (void)is_connected<crazyswarm::TakeoffRequest>(take_off_, "takeoff");  // asked for again when it is needed
}

template <typename Request>
bool DroneServices::is_connected(ros::ServiceClient& client, const char* service) {
  if (client && client.isValid()) return true;
  // A handle that is forgotten with its services: the link's would note each attempt for ever.
  constexpr bool kIsKept = true;
  client = ros::NodeHandle("/").serviceClient<Request, crazyswarm::EmptyResponse<Request>>(
      "/" + ros_name(setup_.id) + "/" + service, kIsKept);
  return client && client.isValid();
}

void DroneServices::make(VehicleCall call) {
  const bool is_landing = call == VehicleCall::kLand;
  is_handed_over_ = false;
  const bool is_done = is_landing ? land() : take_off();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!wanted_) answer_ = is_done ? Answer::kYes : Answer::kNo;
  }
  if (is_done || is_over_) return;
  setup_.tell(setup_.id +
              (is_landing ? ": Crazyswarm does not answer to a landing; where it follows setpoints, they bring it down"
                          : ": Crazyswarm does not answer to a take-off; order it again"));
}

bool DroneServices::take_off() {
  return call(take_off_, "takeoff", height_request<crazyswarm::TakeoffRequest>(setup_.altitude_m, setup_.take_off_s));
}

bool DroneServices::land() {
  if (!let_go()) return false;
  const Clock::time_point until = Clock::now() + kHeldFor;
  held_until_ = until.time_since_epoch().count();
  std::this_thread::sleep_for(kOnTheWay);
  const bool is_done = let_go() && holds_setpoints() &&
                       call(land_, "land", height_request<crazyswarm::LandRequest>(0.0, setup_.landing_s));
  // In time, or setpoints have taken the drone back.
  is_handed_over_ = is_done && Clock::now() + kMargin < until;
  held_until_ = 0;
  return is_handed_over_;
}

bool DroneServices::let_go() {
  crazyswarm::NotifySetpointsStopRequest request;
  request.remainValidMillisecs = 100;
  return call(let_go_, "notify_setpoints_stop", request);
}

template <typename Request>
bool DroneServices::call(ros::ServiceClient& client, const char* service, const Request& request) {
  if (!is_connected<Request>(client, service) || !begin(client)) return false;
  crazyswarm::EmptyResponse<Request> response;
  const bool is_done = client.call(request, response);
  const std::lock_guard<std::mutex> lock(mutex_);
  calling_ = {};
  return is_done;
}

bool DroneServices::begin(const ros::ServiceClient& client) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_over_) return false;
  calling_ = client;
  called_at_ = Clock::now();
  return true;
}

}  // namespace vigil::ros_bridge
