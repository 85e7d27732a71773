#include "vigil/adapters/recording/standard_topics.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "vigil/core/field/density.hpp"
#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::recording {
namespace {

// Topics that there is one of, then three of each drone.
constexpr std::size_t kMetric = 1;
constexpr std::size_t kMetricPercent = 2;
constexpr std::size_t kDensity = 3;
constexpr std::size_t kMarkers = 4;
constexpr std::size_t kDiagnostics = 5;
constexpr std::size_t kShared = 5;
constexpr std::size_t kPose = 1;
constexpr std::size_t kTwist = 2;
constexpr std::size_t kPath = 3;
constexpr std::size_t kOfADrone = 3;

constexpr std::size_t kTrailPoints = 120;
constexpr Eigen::Index kGridCells = 96;  ///< along the field's longer side

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A drone's id as a part of a topic's name may be: letters, digits and _, a letter first.
std::string topic_name(const std::string& id) {
  std::string name;
  for (const char c : id) name.push_back(is_letter(c) || is_digit(c) ? c : '_');
  return name.empty() || !is_letter(name.front()) ? "drone_" + name : name;
}

std::vector<std::string> topic_names(const runtime::Mission& mission, std::size_t drones) {
  std::vector<std::string> names;
  std::set<std::string> taken{"vigil", "diagnostics"};
  for (std::size_t i = 0; i < drones; ++i) {
    std::string name = topic_name(mission.drones[i].id);
    if (taken.contains(name)) name += fmt::format("_{}", i + 1);
    names.push_back(*taken.insert(std::move(name)).first);
  }
  return names;
}

DroneDiagnosis::Level level_of(swarm::Activity activity) {
  using swarm::Activity;
  switch (activity) {
    case Activity::kVehicleFailed:
    case Activity::kEmergencyStop:
    case Activity::kMarkedFailed:
      return DroneDiagnosis::Level::kError;
    case Activity::kTrackingLost:
    case Activity::kLinkLost:
    case Activity::kBatteryLow:
      return DroneDiagnosis::Level::kWarning;
    case Activity::kNeverSeen:
      return DroneDiagnosis::Level::kStale;
    default:
      return DroneDiagnosis::Level::kOk;
  }
}

DroneDiagnosis diagnosis_of(const std::string& id, const swarm::DroneSnapshot& drone) {
  return {.level = level_of(drone.activity),
          .drone = id,
          .message = std::string(swarm::name_of(drone.activity)),
          .values = {{"mode", std::string(swarm::name_of(drone.mode))},
                     {"action", std::string(swarm::name_of(drone.order.action))},
                     {"battery", fmt::format("{:.3f}", drone.battery)},
                     {"age_s", fmt::format("{:.3f}", drone.age_s)},
                     {"link_age_s", fmt::format("{:.3f}", drone.link_age_s)}}};
}

Drawing line(std::string name, std::size_t number, double size_m) {
  Drawing drawing;
  drawing.name = std::move(name);
  drawing.number = static_cast<std::int32_t>(number);
  drawing.size_m = size_m;
  return drawing;
}

void add(Drawing& drawing, const std::vector<Vec2>& points) {
  for (const Vec2& point : points) drawing.places.push_back({point, 0.0});
}

std::vector<Drawing> drawings_of(const runtime::TargetsSection& targets, double size_m) {
  std::vector<Drawing> drawings;
  Drawing points = line("targets", 0, size_m);
  points.kind = Drawing::Kind::kSpheres;
  points.red = 1.0F;
  for (const runtime::ClusterEntry& cluster : targets.clusters) add(points, cluster.points_m);
  drawings.push_back(std::move(points));
  for (std::size_t n = 0; n < targets.areas.size(); ++n) {
    Drawing outline = line("areas", n, 0.3 * size_m);
    outline.red = 1.0F;
    add(outline, targets.areas[n].outline_m);
    add(outline, {targets.areas[n].outline_m.front()});
    drawings.push_back(std::move(outline));
  }
  return drawings;
}

}  // namespace

bool StandardTopics::Beat::is_due(double time_s) {
  constexpr double kRounding = 1e-6;
  if (time_s < next_s - kRounding) return false;
  next_s = time_s + period_s;
  return true;
}

StandardTopics::StandardTopics(const runtime::Mission& mission, std::size_t before)
    : mission_(mission),
      frame_(runtime::world_frame(mission)),
      size_m_(0.02 * runtime::monitored_field(mission).shorter_side()),
      before_(before),
      named_(std::min(mission.drones.size(), kMostNamed)),
      topics_{{"/vigil/metric", "std_msgs/msg/Float64"},
              {"/vigil/metric_percent", "std_msgs/msg/Float64"},
              {"/vigil/density", "nav_msgs/msg/OccupancyGrid"},
              {"/vigil/markers", "visualization_msgs/msg/MarkerArray"},
              {"/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"}},
      trails_(mission.drones.size()) {
  const double slower = std::max(1.0, static_cast<double>(mission.drones.size()) / (0.1 * kMostPosesPerS));
  places_.period_s = 0.1 * slower;
  trail_points_.period_s = 0.5 * slower;
  health_.period_s = 1.0 * slower;
  trails_shown_.period_s = 5.0 * slower;
  paths_.period_s = 30.0 * slower;
  for (const std::string& name : topic_names(mission, named_)) {
    topics_.push_back({fmt::format("/{}/pose", name), "geometry_msgs/msg/PoseStamped"});
    topics_.push_back({fmt::format("/{}/twist", name), "geometry_msgs/msg/TwistStamped"});
    topics_.push_back({fmt::format("/{}/path", name), "nav_msgs/msg/Path"});
  }
}

std::size_t StandardTopics::topic_of(std::size_t drone, std::size_t which) const {
  return before_ + kShared + drone * kOfADrone + which;
}

Place StandardTopics::place_of(const swarm::DroneSnapshot& drone) const {
  return {frame_.point_to_world(drone.position), drone.height_m};
}

void StandardTopics::extend_trails(const swarm::Snapshot& snapshot) {
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    if (snapshot.drones[i].activity == swarm::Activity::kNeverSeen) continue;
    if (trails_[i].size() == kTrailPoints) trails_[i].erase(trails_[i].begin());
    trails_[i].push_back(place_of(snapshot.drones[i]));
  }
}

void StandardTopics::write_tick(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer,
                                BagWriter& bag) {
  const double time_s = snapshot.time_s;
  if (trail_points_.is_due(time_s)) extend_trails(snapshot);
  if (places_.is_due(time_s)) write_places(snapshot, stamp_ns, writer, bag);
  if (health_.is_due(time_s)) write_health(snapshot, stamp_ns, writer, bag);
  if (trails_shown_.is_due(time_s)) write_trails(stamp_ns, writer, bag);
  if (paths_.is_due(time_s)) write_paths(stamp_ns, writer, bag);
}

void StandardTopics::write_places(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer,
                                  BagWriter& bag) {
  if (snapshot.has_metric) {
    write_number(writer, snapshot.metric);
    bag.write(before_ + kMetric, stamp_ns, writer.message());
    write_number(writer, snapshot.metric_percent);
    bag.write(before_ + kMetricPercent, stamp_ns, writer.message());
  }
  for (std::size_t i = 0; i < named_; ++i) {
    const swarm::DroneSnapshot& drone = snapshot.drones[i];
    if (drone.activity == swarm::Activity::kNeverSeen) continue;
    write_pose(writer, stamp_ns, place_of(drone));
    bag.write(topic_of(i, kPose), stamp_ns, writer.message());
    write_twist(writer, stamp_ns, frame_.vector_to_world(drone.velocity));
    bag.write(topic_of(i, kTwist), stamp_ns, writer.message());
  }
}

void StandardTopics::write_paths(std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag) {
  for (std::size_t i = 0; i < named_; ++i) {
    write_path(writer, stamp_ns, trails_[i]);
    bag.write(topic_of(i, kPath), stamp_ns, writer.message());
  }
}

void StandardTopics::write_trails(std::int64_t stamp_ns, CdrWriter& writer, BagWriter& bag) {
  std::vector<Drawing> drawings;
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    Drawing trail = line("trails", i, 0.3 * size_m_);
    trail.green = 0.6F;
    trail.places = trails_[i];
    drawings.push_back(std::move(trail));
  }
  write_drawings(writer, stamp_ns, drawings);
  bag.write(before_ + kMarkers, stamp_ns, writer.message());
}

void StandardTopics::write_health(const swarm::Snapshot& snapshot, std::int64_t stamp_ns, CdrWriter& writer,
                                  BagWriter& bag) {
  std::vector<DroneDiagnosis> diagnoses;
  for (std::size_t i = 0; i < snapshot.drones.size(); ++i)
    diagnoses.push_back(diagnosis_of(mission_.drones[i].id, snapshot.drones[i]));
  write_diagnoses(writer, stamp_ns, diagnoses);
  bag.write(before_ + kDiagnostics, stamp_ns, writer.message());
}

void StandardTopics::write_targets(const runtime::MissionTargets& targets, std::int64_t stamp_ns, CdrWriter& writer,
                                   BagWriter& bag) {
  write_drawings(writer, stamp_ns, drawings_of(targets.targets, size_m_));
  bag.write(before_ + kMarkers, stamp_ns, writer.message());
  mission_.targets = targets.targets;
  mission_.no_fly = targets.no_fly;
  const field::Field field = runtime::monitored_field(mission_);
  const auto density = field::rasterise(field, runtime::importance(mission_), runtime::grid_of(field, kGridCells));
  if (!density) return;
  write_grid(writer, stamp_ns, *density, frame_);
  bag.write(before_ + kDensity, stamp_ns, writer.message());
}

}  // namespace vigil::recording
