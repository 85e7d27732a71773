#include "vigil/adapters/ros/operator_topics.hpp"

#include <chrono>
#include <cmath>
#include <future>
#include <utility>

#include <geometry_msgs/PointStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>

#include "vigil/adapters/ros/registry.hpp"

namespace vigil::ros_bridge {
namespace {

using Reply = std_srvs::Trigger::Response;
using Answer = OperatorWishes::Answer;

constexpr auto kAnswerWithin = std::chrono::seconds(2);
constexpr std::size_t kMostIdBytes = 200;

/// Of topics, which have no answer.
Answer answer_to_log(const char* what) {
  return [what](const std::string& refusal) {
    if (!refusal.empty()) ROS_WARN("vigil: %s: refused: %s", what, refusal.c_str());
  };
}

/// Waits for the answer of a wish, which may come from another thread.
bool answer(Reply& reply, const std::function<void(Answer)>& wish) {
  const auto promise = std::make_shared<std::promise<std::string>>();
  std::future<std::string> refusal = promise->get_future();
  wish([promise](const std::string& text) { promise->set_value(text); });
  if (refusal.wait_for(kAnswerWithin) != std::future_status::ready) {
    reply.success = 0U;
    reply.message = "no answer yet; look at the console or the topics for what became of it";
    return true;
  }
  reply.message = refusal.get();
  reply.success = static_cast<Reply::_success_type>(reply.message.empty());
  return true;
}

}  // namespace

class OperatorTopics::Inputs {
 public:
  explicit Inputs(OperatorWishes wishes) : wishes_(std::move(wishes)) {
    node_.setCallbackQueue(&queue_);
    clicked_ = node_.subscribe("/clicked_point", 10, &Inputs::click, this);
    land_ = node_.subscribe("land", 10, &Inputs::land, this);
    serve("new_cluster", [this](Reply& reply) {
      reply.message = wishes_.begin_cluster();
      reply.success = 1U;
      return true;
    });
    serve("clear_targets", [this](Reply& reply) { return answer(reply, wishes_.clear_targets); });
    serve("start_afresh", [this](Reply& reply) { return answer(reply, wishes_.start_afresh); });
    serve("take_off_all", [this](Reply& reply) { return answer(reply, wishes_.take_off_all); });
    serve("land_all",
          [this](Reply& reply) { return answer(reply, [this](Answer then) { wishes_.land("", std::move(then)); }); });
    spinner_.start();
  }

  ~Inputs() {
    spinner_.stop();
    queue_.disable();
  }

  Inputs(const Inputs&) = delete;
  Inputs& operator=(const Inputs&) = delete;

 private:
  void serve(const std::string& name, std::function<bool(Reply&)> work) {
    const auto wrapped = [work = std::move(work)](std_srvs::Trigger::Request&, Reply& reply) { return work(reply); };
    services_.push_back(node_.advertiseService<std_srvs::Trigger::Request, Reply>(name, wrapped));
    note_service(services_.back().getService());
  }

  void click(const geometry_msgs::PointStamped& clicked) const {
    const std::string& frame = clicked.header.frame_id;
    if (frame != "world" && frame != "/world") {
      ROS_WARN("vigil: /clicked_point in frame %.60s: ignored; set RViz' Fixed Frame to world", frame.c_str());
      return;
    }
    if (!std::isfinite(clicked.point.x) || !std::isfinite(clicked.point.y)) return;
    wishes_.add_target(clicked.point.x, clicked.point.y, answer_to_log("/clicked_point"));
  }

  void land(const std_msgs::String& drone) const {
    if (drone.data.empty() || drone.data.size() > kMostIdBytes) {
      ROS_WARN("vigil: /vigil/land: wants a drone's id of 1 to %zu letters", kMostIdBytes);
      return;
    }
    wishes_.land(drone.data, answer_to_log("/vigil/land"));
  }

  OperatorWishes wishes_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_{"/vigil"};
  ros::Subscriber clicked_;
  ros::Subscriber land_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

OperatorTopics::OperatorTopics(OperatorWishes wishes) : inputs_(std::make_unique<Inputs>(std::move(wishes))) {}

OperatorTopics::~OperatorTopics() = default;

}  // namespace vigil::ros_bridge
