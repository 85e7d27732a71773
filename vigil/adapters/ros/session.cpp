#include "vigil/adapters/ros/session.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <ros/master.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/this_node.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>

#include "vigil/adapters/ros/registry.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::ros_bridge {
namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(100);
constexpr int kLooksAMaster = 10;

/// Of roscore: another one for each time it starts. Empty: nobody answers.
std::string master_run() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  request[1] = "/run_id";
  if (!ros::master::execute("getParam", request, response, payload, false)) return {};
  return payload.getType() == XmlRpc::XmlRpcValue::TypeString ? std::string(payload) : std::string();
}

/// Where the master knows a node of this one's name, which may have died without a word; empty: it knows none.
std::string namesake() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue payload;
  request[0] = ros::this_node::getName();
  request[1] = ros::this_node::getName();
  if (!ros::master::execute("lookupNode", request, response, payload, false)) return {};
  return payload.getType() == XmlRpc::XmlRpcValue::TypeString ? std::string(payload) : std::string();
}

bool answers(const std::string& uri) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  request[0] = ros::this_node::getName();
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  return client.execute("getPid", request, response);
}

/// A master lets the newest node of a name take the place of the one before, which is deaf from then on.
void refuse_a_second_one() {
  const std::string uri = namesake();
  if (!uri.empty() && answers(uri))
    throw RosError("a ROS node of the name " + ros::this_node::getName() + " is alive at " + uri +
                   ", and would be cut off by this one; end it first, or use another ROS master");
}

void start_node(const std::string& node) {
  if (!ros::isInitialized())
    ros::init(ros::M_string(), node, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  // Whoever asks the master must not wait for one that died.
  ros::master::setRetryTimeout(ros::WallDuration(0.5));
  if (!ros::master::check())
    throw RosError("no ROS master answers at " + ros::master::getURI() +
                   "; start roscore there, set ROS_MASTER_URI to where it is, or start all by ./run --with-ros");
  refuse_a_second_one();
  // roscpp writes what is published, and reads what comes, on threads of its own, which it starts here.
  runtime::start_with_real_time_priority(ros::start);
}

}  // namespace

class Session::Watch {
 public:
  explicit Watch(std::function<void(const std::string&)> tell)
      : tell_(std::move(tell)), run_(master_run()), thread_([this] { watch(); }) {}

  ~Watch() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_over_ = true;
    }
    over_.notify_one();
    thread_.join();
  }

  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  void watch() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!over_.wait_for(lock, kLookEvery, [this] { return is_over_; })) {
      lock.unlock();
      look();
      lock.lock();
    }
  }

  void look() {
    look_at_node();
    if (looks_++ % kLooksAMaster == 0 && ros::ok()) look_at_master();
  }

  void look_at_node() {
    if (ros::ok() || is_shut_down_) return;
    is_shut_down_ = true;
    tell_(
        "ROS has shut this program's node down: another node took its name, or somebody ended it. Nothing is sent or "
        "heard "
        "any more: drones in the air level after half a second and fall after two. Start the program again");
  }

  void look_at_master() {
    const std::string run = master_run();
    if (run.empty() && !is_gone_) tell_("the ROS master does not answer; connections that are there go on without it");
    is_gone_ = run.empty();
    if (is_gone_ || run == run_) return;
    if (!register_everything()) return;  // it is not wholly up yet: next time
    run_ = run;
    tell_("the ROS master is back: everything is registered with it again");
  }

  std::function<void(const std::string&)> tell_;
  std::string run_;
  bool is_gone_ = false;
  bool is_shut_down_ = false;
  int looks_ = 1;
  std::mutex mutex_;
  std::condition_variable over_;
  bool is_over_ = false;
  std::thread thread_;
};

Session::Session(const std::string& node, std::function<void(const std::string&)> tell) {
  start_node(node);
  watch_ = std::make_unique<Watch>(std::move(tell));
}

Session::~Session() {
  watch_.reset();
  ros::shutdown();
}

}  // namespace vigil::ros_bridge
