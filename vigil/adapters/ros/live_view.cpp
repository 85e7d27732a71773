#include "vigil/adapters/ros/live_view.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "vigil/adapters/ros/displays.hpp"
#include "vigil/adapters/ros/mission_scene.hpp"
#include "vigil/adapters/ros/swarm_scene.hpp"

namespace vigil::ros_bridge {
namespace {

using namespace std::chrono_literals;

constexpr auto kPaintEvery = 100ms;
constexpr int kPaintsATrail = 3;
constexpr int kPaintsADiagnosis = 10;

std::vector<std::string> ids_of(const runtime::Mission& mission) {
  std::vector<std::string> ids;
  for (const runtime::DroneEntry& drone : mission.drones) ids.push_back(drone.id);
  return ids;
}

}  // namespace

/// Of one flight.
class LiveView::Painter {
 public:
  explicit Painter(std::shared_ptr<runtime::LiveMission> flight)
      : flight_(std::move(flight)), mission_(flight_->mission()), frame_(mission_.drones.size()) {}

  void aim(const runtime::Mission& mission) {
    mission_.targets = mission.targets;
    mission_.no_fly = mission.no_fly;
    displays_.show(density_picture(mission_));
    displays_.show_targets(target_marks(mission_));
  }

  void paint() {
    if (!flight_->loop().read(frame_, version_) || !frame_.has_ticked) return;
    trails_.add(frame_.snapshot);
    displays_.show_drones(drone_marks(mission_, frame_.snapshot));
    displays_.show(figures_of(mission_, frame_.snapshot));
    if (paints_ % kPaintsATrail == 0) paint_trails();
    if (paints_ % kPaintsADiagnosis == 0) displays_.show(diagnoses_of(mission_, frame_.snapshot));
    ++paints_;
  }

 private:
  void paint_trails() {
    displays_.show_trails(trails_.marks());
    for (std::size_t i = 0; i < mission_.drones.size(); ++i) displays_.show_path(i, trails_.of(i));
  }

  std::shared_ptr<runtime::LiveMission> flight_;
  runtime::Mission mission_;
  runtime::LiveFrame frame_;
  std::size_t version_ = 0;
  int paints_ = 0;
  Trails trails_{mission_};
  Displays displays_{ids_of(mission_)};
};

LiveView::LiveView() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

LiveView::~LiveView() = default;

void LiveView::watch(std::shared_ptr<runtime::LiveMission> flight) {
  const std::lock_guard lock(mutex_);
  flight_ = std::move(flight);
  is_other_flight_ = true;
  aimed_at_.reset();
}

void LiveView::aim(const runtime::Mission& mission) {
  const std::lock_guard lock(mutex_);
  aimed_at_ = mission;
}

void LiveView::stop() { thread_ = {}; }

void LiveView::run(const std::stop_token& stop) {
  std::optional<Painter> painter;
  auto next = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, stop, next, [] { return false; });
    next += kPaintEvery;
    const bool is_other = std::exchange(is_other_flight_, false);
    std::shared_ptr<runtime::LiveMission> flight = is_other ? flight_ : nullptr;
    const std::optional<runtime::Mission> aimed_at = std::exchange(aimed_at_, std::nullopt);
    lock.unlock();
    if (flight) painter.emplace(std::move(flight));
    if (!painter) continue;
    if (aimed_at) painter->aim(*aimed_at);
    painter->paint();
  }
}

}  // namespace vigil::ros_bridge
