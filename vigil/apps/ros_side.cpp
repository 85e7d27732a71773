#include "vigil/apps/ros_side.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "vigil/adapters/ros/ros_name.hpp"
#include "vigil/apps/failure.hpp"

namespace vigil::apps {
namespace {

using runtime::TargetKind;

bool has_cluster(const runtime::Mission& mission, const std::string& name) {
  return std::ranges::any_of(mission.targets.clusters,
                             [&](const runtime::ClusterEntry& cluster) { return cluster.name == name; });
}

/// "rviz-1", or the next that is free.
std::string free_name(const runtime::Mission& mission) {
  for (int number = 1;; ++number)
    if (std::string name = fmt::format("rviz-{}", number); !has_cluster(mission, name)) return name;
}

std::vector<runtime::TargetEdit> removal_of_all(const runtime::Mission& mission) {
  std::vector<runtime::TargetEdit> edits;
  for (const runtime::ClusterEntry& cluster : mission.targets.clusters)
    edits.emplace_back(runtime::RemoveEntry{{TargetKind::kCluster, cluster.name}});
  for (const runtime::AreaEntry& area : mission.targets.areas)
    edits.emplace_back(runtime::RemoveEntry{{TargetKind::kArea, area.name}});
  return edits;
}

}  // namespace

void check_ros_names(const runtime::Mission& mission) {
  std::vector<std::string> ids;
  for (const runtime::DroneEntry& drone : mission.drones) ids.push_back(drone.id);
  if (const std::string complaint = ros_bridge::complaint_of_names(ids); !complaint.empty())
    throw Failure(kBadInput, complaint);
}

RosSide::RosSide(console::Role role)
    : role_(role), session_("vigil", [this](const std::string& text) { warn(text); }) {}

void RosSide::overhear(const console::DeskNews& news) {
  if (const auto* flight = std::get_if<console::FlightNews>(&news)) view_.watch(flight->flight);
  if (const auto* targets = std::get_if<console::TargetsNews>(&news)) {
    view_.aim(targets->mission);
    const std::lock_guard lock(mutex_);
    mission_ = targets->mission;
    revision_ = targets->revision;
    if (cluster_.empty()) cluster_ = free_name(*mission_);
  }
}

void RosSide::attach(console::Server& server) {
  {
    const std::lock_guard lock(mutex_);
    server_ = &server;
  }
  topics_.emplace(wishes());
}

void RosSide::release() {
  topics_.reset();
  view_.stop();
  const std::lock_guard lock(mutex_);
  server_ = nullptr;
}

ros_bridge::OperatorWishes RosSide::wishes() {
  using swarm::CommandKind;
  return {
      .add_target = [this](double x_m, double y_m, Answer answer) { add_target({x_m, y_m}, std::move(answer)); },
      .begin_cluster = [this] { return begin_cluster(); },
      .clear_targets = [this](Answer answer) { clear_targets(std::move(answer)); },
      .start_afresh = [this](Answer answer) { ask(console::StartAfresh{}, "start_afresh", std::move(answer)); },
      .take_off_all = [this](Answer answer) { wish(CommandKind::kTakeOff, "", std::move(answer)); },
      .land = [this](const std::string& drone, Answer answer) { wish(CommandKind::kLand, drone, std::move(answer)); }};
}

void RosSide::ask(console::MessageBody body, const char* type, Answer answer) {
  const std::lock_guard lock(mutex_);
  if (server_ == nullptr) return answer("the program ends");
  server_->command({.id = 0, .type = type, .body = std::move(body)}, role_, "ROS", std::move(answer));
}

void RosSide::add_target(const Vec2& place_W, Answer answer) {
  console::Edit edit;
  {
    const std::lock_guard lock(mutex_);
    edit.based_on = revision_;
    edit.edits.emplace_back(runtime::AddPoint{{TargetKind::kCluster, cluster_}, place_W, {}});
  }
  ask(std::move(edit), "edit", std::move(answer));
}

std::string RosSide::begin_cluster() {
  const std::lock_guard lock(mutex_);
  if (mission_) cluster_ = free_name(*mission_);
  return cluster_;
}

void RosSide::clear_targets(Answer answer) {
  console::Edit edit;
  {
    const std::lock_guard lock(mutex_);
    if (mission_) edit.edits = removal_of_all(*mission_);
    edit.based_on = revision_;
  }
  if (edit.edits.empty()) return answer("");
  ask(std::move(edit), "edit", std::move(answer));
}

void RosSide::wish(swarm::CommandKind kind, const std::string& drone, Answer answer) {
  console::DroneWish wish;
  wish.kind = kind;
  wish.all = drone.empty();
  if (!wish.all) wish.drones.push_back(drone);
  ask(std::move(wish), kind == swarm::CommandKind::kLand ? "land" : "take_off", std::move(answer));
}

void RosSide::warn(const std::string& text) {
  fmt::print("vigil: {}\n", text);
  std::fflush(stdout);
  const std::lock_guard lock(mutex_);
  if (server_ != nullptr) server_->warn(text);
}

}  // namespace vigil::apps
