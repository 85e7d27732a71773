#include "vigil/runtime/mission_file.hpp"

#include "vigil/runtime/drone_grid.hpp"
#include "vigil/runtime/mission_checks.hpp"
#include "vigil/runtime/mission_reader.hpp"
#include "vigil/runtime/mission_text.hpp"

namespace vigil::runtime {
namespace {

/// Who shortens a mission from the command line does not want to edit its events; in a file the two contradict.
void drop_events_after_the_end(Mission& mission, const MissionSource& source) {
  if (!source.is_overridden("simulation.duration_s")) return;
  std::vector<EventEntry>& events = mission.simulation.events;
  while (!events.empty() && events.back().at_s > mission.simulation.duration_s) events.pop_back();
}

}  // namespace

Mission parse_mission(std::string_view text, const std::string& name, std::span<const Override> overrides) {
  const MissionSource source(text, name, overrides);
  Mission mission = read_mission(source);
  check_numbers(mission, source);
  drop_events_after_the_end(mission, source);
  check_places(mission, source);
  check_stations(mission, source);
  if (mission.drone_grid) mission.drones = drones_on_grid(mission, source);
  check_drones(mission, source);
  check_events(mission, source);
  return mission;
}

Mission load_mission(const std::filesystem::path& path, std::span<const Override> overrides) {
  return parse_mission(read_mission_text(path), path.string(), overrides);
}

}  // namespace vigil::runtime
