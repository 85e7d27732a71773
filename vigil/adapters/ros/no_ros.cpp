// What takes the place of the files that speak to roscpp where there is none: a session cannot begin, and without one
// nothing else is asked for.
#include "vigil/adapters/ros/crazyswarm_link.hpp"
#include "vigil/adapters/ros/displays.hpp"
#include "vigil/adapters/ros/laboratory_link.hpp"
#include "vigil/adapters/ros/operator_topics.hpp"
#include "vigil/adapters/ros/session.hpp"

namespace vigil::ros_bridge {

class Session::Watch {};
class Displays::Topics {};
class OperatorTopics::Inputs {};
class StandInCrazyswarm::Wire {};
class StandInVicon::Wire {};

Session::Session(const std::string& /*node*/, std::function<void(const std::string&)> /*tell*/) {
  throw RosError(
      "this program was built without ROS; install libroscpp-dev and libvisualization-msgs-dev and build it again, or "
      "start ./run --with-ros, which does both");
}
Session::~Session() = default;

Displays::Displays(const std::vector<std::string>& /*drones*/) {}
Displays::~Displays() = default;
void Displays::show(const DensityPicture& /*density*/) {}
void Displays::show_targets(const std::vector<Mark>& /*marks*/) {}
void Displays::show_trails(const std::vector<Mark>& /*marks*/) {}
void Displays::show_drones(const std::vector<Mark>& /*marks*/) {}
void Displays::show_path(std::size_t /*drone*/, const std::vector<Point>& /*places*/) {}
void Displays::show(const std::vector<Figure>& /*figures*/) {}
void Displays::show(const std::vector<Diagnosis>& /*diagnoses*/) {}

OperatorTopics::OperatorTopics(OperatorWishes /*wishes*/) {}
OperatorTopics::~OperatorTopics() = default;

std::unique_ptr<CrazyswarmPort> link_to_crazyswarm(const CrazyswarmSetup& /*setup*/) { return nullptr; }

StandInCrazyswarm::StandInCrazyswarm(const std::vector<std::string>& /*drones*/) {}
StandInCrazyswarm::~StandInCrazyswarm() = default;
StandInCrazyswarm::Told StandInCrazyswarm::take(std::size_t /*drone*/) { return {}; }
void StandInCrazyswarm::show(const std::vector<Point>& /*places*/) {}

StandInVicon::StandInVicon(const std::vector<std::string>& /*drones*/) {}
StandInVicon::~StandInVicon() = default;

}  // namespace vigil::ros_bridge
