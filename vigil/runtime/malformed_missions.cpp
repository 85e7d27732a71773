#include "vigil/runtime/malformed_missions.hpp"

#include <stdexcept>

namespace vigil::runtime {
namespace {

constexpr std::string_view kRight = R"(format: 1
name: small
field:
  size_m: [4, 3]
  origin_m: [-2, -1.5]
targets:
  clusters:
    - {name: north, points_m: [[0, 1], [0.2, 1.1]], revisit_s: 30}
  areas:
    - {name: corner, outline_m: [[1, -1], [1.5, -1], [1.5, -0.5]]}
no_fly:
  - {name: mast, outline_m: [[-1.4, 0.4], [-1, 0.4], [-1, 0.8], [-1.4, 0.8]]}
drones:
  - {id: a, start_m: [-1, -1]}
  - {id: b, start_m: [0, 0]}
control:
  rate_hz: 50
  speed_limit_m_s: 0.3
safety:
  barrier: lag_aware
  separation_m: 0.2
  wall_distance_m: 0.1
  lag_s: 0.1
health: {battery_reserve: 0.2}
sensor: {footprint_radius_m: 0.3}
simulation:
  duration_s: 60
  vehicle: {model: first_order_lag, lag_s: 0.1}
  events:
    - {at_s: 10, do: land, drone: b}
    - {at_s: 20, do: add_target, cluster: west, point_m: [-1.5, 0]}
    - {at_s: 30, do: move_target, cluster: west, target: 1, point_m: [-1.5, -0.5]}
)";

std::string nested(std::size_t depth) { return "x: " + std::string(depth, '[') + std::string(depth, ']') + "\n"; }

std::string alias_bomb() {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int n = 0; n < 9; ++n) text += last + ", ";
    text += last + "]\n";
  }
  return text;
}

void add_broken_texts(std::vector<MalformedMission>& table) {
  const auto add = [&](std::string name, std::string text, std::string message) {
    table.push_back({std::move(name), std::move(text), Fault::kText, "", std::move(message)});
  };
  add("empty file", "", "is empty");
  add("nothing but a comment", "# later\n", "is empty");
  add("nothing but null", "~\n", "is empty");
  add("binary file",
      std::string("\x7F"
                  "ELF\x02\x01\x01\x00\x00\x00",
                  10),
      "control character 0x7f");
  add("a NUL", std::string("format: 1\nname: a\0b\n", 20), "control character 0x00");
  add("Latin-1", "name: caf\xE9\n", "is not UTF-8");
  add("UTF-16", "\xFF\xFE n a m e", "is not UTF-8");
  add("a surrogate", "name: \xED\xA0\x80\n", "is not UTF-8");
  add("an overlong NUL", "name: \xC0\x80\n", "is not UTF-8");
  add("a tab for indentation", right_mission_but("  size_m", "\tsize_m"), "tab in its indentation");
  add("a file beyond 1 MiB", "# " + std::string(1U << 20U, 'x'), "must be a text file of at most 1048576 bytes");
  add("two documents", std::string(kRight) + "---\nname: other\n", "second document");
  add("a cyclic alias", "format: &x [*x]\n", "anchor or alias");
  add("an alias bomb", alias_bomb(), "anchor or alias");
  add("an alias to nothing", right_mission_but("speed_limit_m_s: 0.3", "speed_limit_m_s: *fast"), "is not YAML");
  add("a merge key", "base: &base {a: 1}\nformat:\n  <<: *base\n", "anchor or alias");
  add("deep nesting", nested(100), "nested too deeply");
  add("very deep nesting", nested(100'000), "nested too deeply");
  add("an open bracket", right_mission_but("[4, 3]", "[4, 3"), "is not YAML");
  // The parser takes the end of the file for the end of the quote, and the rest of the file for the name.
  table.push_back({"an open quote", right_mission_but("name: small", "name: \"small"), Fault::kText, "name",
                   "one line of 1 to 64"});
  add("a colon too many", right_mission_but("name: small", "name: small: mission"), "is not YAML");
  add("a tag", right_mission_but("rate_hz: 50", "rate_hz: !!python/object 50"), "has the tag");
  add("a duplicate key", right_mission_but("rate_hz: 50", "rate_hz: 50\n  rate_hz: 60"),
      "key rate_hz twice, first in line 17");
  add("a list for a key", "? [1, 2]\n: 3\n", "list or section for a key");
  add("a word alone in a section", right_mission_but("rate_hz: 50", "rate_hz"), "is not YAML");
  add("a text beyond all measure", right_mission_but("name: small", "name: " + std::string(5000, 'n')),
      "text of 5000 bytes");
}

void add_broken_structures(std::vector<MalformedMission>& table) {
  const auto add = [&](std::string name, std::string text, std::string key, std::string message) {
    table.push_back({std::move(name), std::move(text), Fault::kStructure, std::move(key), std::move(message)});
  };
  const auto but = right_mission_but;
  add("a single word", "paper\n", "", "is a single value");
  add("a list", "- format: 1\n", "", "is a list");
  add("no format", but("format: 1\n", ""), "format", "is missing; must be 1");
  add("a format of the future", but("format: 1", "format: 2"), "format", "must be 1");
  add("a missing section", but("field:\n  size_m: [4, 3]\n  origin_m: [-2, -1.5]\n", ""), "field", "is missing");
  add("a missing key", but("  speed_limit_m_s: 0.3\n", ""), "control.speed_limit_m_s",
      "is missing; must be a number in (0, 100] m/s");
  add("an empty value", but("separation_m: 0.2", "separation_m:"), "safety.separation_m", "is empty");
  add("an empty section", but("health: {battery_reserve: 0.2}", "health:"), "health", "is empty; must be a section");
  add("a text for a number", but("rate_hz: 50", "rate_hz: fast"), "control.rate_hz", "= fast: is not a number");
  add("a number in quotes", but("rate_hz: 50", "rate_hz: \"50\""), "control.rate_hz", "remove the quotes");
  add("a unit in a value", but("speed_limit_m_s: 0.3", "speed_limit_m_s: 0.3 m/s"), "control.speed_limit_m_s",
      "write the number alone; its unit, m/s, is fixed by the key");
  add("a decimal comma", but("speed_limit_m_s: 0.3", "speed_limit_m_s: 0,3"), "control.speed_limit_m_s",
      "more than a number");
  add("a hexadecimal number", but("rate_hz: 50", "rate_hz: 0x32"), "control.rate_hz", "more than a number");
  add("not a number", but("rate_hz: 50", "rate_hz: .nan"), "control.rate_hz", "is not a finite number");
  add("infinity", but("lag_s: 0.1\nhealth", "lag_s: .inf\nhealth"), "safety.lag_s", "is not a finite number");
  add("a number beyond doubles", but("rate_hz: 50", "rate_hz: 1e999"), "control.rate_hz", "too large or too small");
  add("a list for a number", but("rate_hz: 50", "rate_hz: [50]"), "control.rate_hz", "is a list; must be a number");
  add("a number for a list", but("[[0, 1], [0.2, 1.1]]", "3"), "targets.clusters[0].points_m",
      "is a single value; must be a list");
  add("a number for a text", but("name: small", "name: 42"), "name", "put it in quotes");
  add("a truth value for a text", but("{id: a", "{id: true"), "drones[0].id", "put it in quotes");
  add("a truth value for a number", but("rate_hz: 50", "rate_hz: true"), "control.rate_hz", "is not a number");
  add("a fraction for a whole number", but("rate_hz: 50", "rate_hz: 50\n  basis_max_index: 2.5"),
      "control.basis_max_index", "is not a whole number");
  add("a basis too large", but("rate_hz: 50", "rate_hz: 50\n  basis_max_index: 65"), "control.basis_max_index",
      "in [1, 64]");
  add("a negative seed", but("duration_s: 60", "duration_s: 60\n  seed: -1"), "simulation.seed", "whole number in [0,");
  add("a negative radius", but("separation_m: 0.2", "separation_m: -0.2"), "safety.separation_m",
      "= -0.2: must be in (0, 100000] m; give the least allowed distance");
  add("a rate of zero", but("rate_hz: 50", "rate_hz: 0"), "control.rate_hz", "must be in [1, 1000] Hz");
  add("a tiny field", but("[4, 3]", "[4, 0.1]"), "field.size_m[1]", "must be in [0.5, 100000] m");
  add("a point in space", but("[-1, -1]", "[-1, -1, 2]"), "drones[0].start_m", "has 3 numbers; must be [x, y]");
  add("a point of words", but("[-1, -1]", "[left, -1]"), "drones[0].start_m[0]", "is not a number");
  add("no drones", but("drones:\n  - {id: a, start_m: [-1, -1]}\n  - {id: b, start_m: [0, 0]}\n", ""), "drones",
      "must be either drones or drone_grid");
  add("an empty list of drones",
      but("drones:\n  - {id: a, start_m: [-1, -1]}\n  - {id: b, start_m: [0, 0]}\n", "drones: []\n"), "drones",
      "has 0 entries");
  add("both kinds of drones", but("control:", "drone_grid: {count: 2}\ncontrol:"), "drone_grid",
      "is given beside drones");
  add("a blank in an id", but("{id: a", "{id: \"a b\""), "drones[0].id", "1 to 32 of the characters");
  add("a name of two lines", but("name: small", "name: \"two\\nlines\""), "name", "one line of 1 to 64 characters");
  add("an unknown key", but("rate_hz: 50", "rate_hz: 50\n  colour: red"), "control.colour", "must be one of: rate_hz,");
  add("a misspelt key", but("separation_m: 0.2", "seperation_m: 0.2"), "safety.seperation_m",
      "did you mean separation_m?");
  add("a key without its unit", but("speed_limit_m_s: 0.3", "speed_limit: 0.3"), "control.speed_limit",
      "did you mean speed_limit_m_s? units are part of the key");
  add("a key with another unit", but("separation_m: 0.2", "separation_cm: 20"), "safety.separation_cm",
      "did you mean separation_m? units are SI");
  add("an unknown choice", but("barrier: lag_aware", "barrier: lagaware"), "safety.barrier", "did you mean lag_aware?");
  add("a choice that is none", but("barrier: lag_aware", "barrier: wall"), "safety.barrier",
      "must be one of: paper, lag_aware");
  add("a polygon of two points", but("[[1, -1], [1.5, -1], [1.5, -0.5]]", "[[1, -1], [1.5, -1]]"),
      "targets.areas[0].outline_m", "has 2 entries; must be a list of 3 to 1000 points");
  add("an event of no kind", but("do: land, ", ""), "simulation.events[0].do",
      "is missing; must be one of: take_off, land");
  add("an unknown event", but("do: land", "do: explode"), "simulation.events[0].do", "is not known");
  add("an event without its drone", but("do: land, drone: b", "do: land"), "simulation.events[0].drone", "is missing");
  add("an event with another's key", but("do: land, drone: b", "do: land, drone: b, weight: 2"),
      "simulation.events[0].weight", "must be one of: at_s, do, drone");
  add("a shift of nothing", but("do: land, drone: b", "do: shift_tracking, drone: b, for_s: 2"),
      "simulation.events[0].shift_m", "is missing");
  add("a drift that never ends", but("do: land, drone: b", "do: drift, drone: b, velocity_m_s: [1, 0], for_s: .inf"),
      "simulation.events[0].for_s", "must be a number in (0, 1000000] s");
  add("an unasked landing for a while", but("do: land, drone: b", "do: land_by_itself, drone: b, for_s: 3"),
      "simulation.events[0].for_s", "must be one of: at_s, do, drone");
  add("an event before the start", but("at_s: 10", "at_s: -10"), "simulation.events[0].at_s",
      "must be in [0, 1000000] s");
  add("a battery of 20 percent in percent", but("battery_reserve: 0.2", "battery_reserve: 20"),
      "health.battery_reserve", "must be in [0, 0.95]");
  add("an unknown vehicle", but("model: first_order_lag", "model: crazyfly"), "simulation.vehicle.model",
      "did you mean crazyflie?");
  add("a link that loses everything", but("duration_s: 60", "duration_s: 60\n  link: {loss: 1}"),
      "simulation.link.loss", "must be in [0, 0.99]");
  add("a negative jitter", but("duration_s: 60", "duration_s: 60\n  link: {jitter_s: -0.1}"),
      "simulation.link.jitter_s", "must be in [0, 10] s");
  add("a tracker that never measures", but("duration_s: 60", "duration_s: 60\n  tracker: {rate_hz: 0}"),
      "simulation.tracker.rate_hz", "must be in [0.01, 1000] Hz");
  add("a word for a truth value", but("duration_s: 60", "duration_s: 60\n  tracker: {over_link: yes}"),
      "simulation.tracker.over_link", "is no truth value; must be true or false");
  add("a truth value in quotes", but("duration_s: 60", "duration_s: 60\n  tracker: {over_link: \"true\"}"),
      "simulation.tracker.over_link", "must be true or false");
  add("an empty battery", but("duration_s: 60", "duration_s: 60\n  battery: {start: 0}"), "simulation.battery.start",
      "must be in (0, 1]");
  add("a battery without its keys", but("duration_s: 60", "duration_s: 60\n  battery:"), "simulation.battery",
      "must be a section");
  add("a wind without a direction", but("duration_s: 60", "duration_s: 60\n  wind: {mean_m_s: 4}"),
      "simulation.wind.mean_m_s", "must be [x, y]");
  add("gusts that last no time", but("duration_s: 60", "duration_s: 60\n  wind: {gust_time_s: 0}"),
      "simulation.wind.gust_time_s", "must be in [0.01, 3600] s");
}

void add_contradictions(std::vector<MalformedMission>& table) {
  const auto add = [&](std::string name, std::string text, std::string key, std::string message) {
    table.push_back({std::move(name), std::move(text), Fault::kMeaning, std::move(key), std::move(message)});
  };
  const auto but = right_mission_but;
  const auto with_pads = [&](const std::string& pads) {
    return but("control:\n", "stations: [{name: west, pads_m: " + pads + "}]\ncontrol:\n");
  };
  add("a pad at the wall", with_pads("[[-1.95, 0]]"), "stations[0].pads_m[0]", "closer to the field's border");
  add("a pad beside the field", with_pads("[[5, 0]]"), "stations[0].pads_m[0]", "closer to the field's border");
  add("a pad in a no-fly polygon", with_pads("[[-1.2, 0.6]]"), "stations[0].pads_m[0]", "in the no-fly polygon mast");
  add("pads on top of each other", with_pads("[[1, 0], [1.1, 0]]"), "stations[0].pads_m[1]", "from every other pad");
  add("two stations of one name",
      but("control:\n", "stations: [{name: west, pads_m: [[1, 0]]}, {name: west, pads_m: [[1, 1]]}]\ncontrol:\n"),
      "stations[1].name", "is also the name of stations[0]");
  add("a failure of a station that there is not", but("do: land, drone: b", "do: fail_station, station: west"),
      "simulation.events[0].station", "is no station of this mission");
  add("R_s larger than the field", but("separation_m: 0.2", "separation_m: 3.5"), "safety.separation_m",
      "below the field's shorter side, 3 m");
  add("a contact distance beyond R_s", but("separation_m: 0.2", "separation_m: 0.2\n  contact_distance_m: 0.3"),
      "safety.contact_distance_m", "must be in (0, 0.2] m");
  add("walls that meet", but("wall_distance_m: 0.1", "wall_distance_m: 1.5"), "safety.wall_distance_m", "below half");
  // R = hypot(0.2, sqrt(5) 0.3 0.02) = 0.200449, 2 w = 0.06, 2 u_max dt = 0.012: 2 w + hypot(R, 2 w) + 2 u_max dt.
  add("a sensing range that lets drones meet behind the barrier",
      but("lag_s: 0.1\nhealth", "lag_s: 0.1\n  sensing_range_m: 0.22\nhealth"), "safety.sensing_range_m",
      "must be at least 0.281237 m");
  add("the paper's sensing range below R_s + 2 u_max dt",
      but("barrier: lag_aware\n  separation_m: 0.2\n  wall_distance_m: 0.1\n  lag_s: 0.1",
          "barrier: paper\n  separation_m: 0.2\n  wall_distance_m: 0.1\n  sensing_range_m: 0.21"),
      "safety.sensing_range_m", "must be at least 0.212 m");
  add("a wall range below R_wall + u_max dt", but("lag_s: 0.1\nhealth", "lag_s: 0.1\n  wall_range_m: 0.1\nhealth"),
      "safety.wall_range_m", "must be at least 0.106 m");
  add("a memory that is endless and fades", but("rate_hz: 50", "memory: endless\n  memory_s: 60"), "control.memory_s",
      "must be left out there");
  add("a lag for the paper's barrier", but("barrier: lag_aware", "barrier: paper"), "safety.lag_s", "must be 0 there");
  add("a lag for the ideal vehicle", but("{model: first_order_lag, lag_s: 0.1}", "{model: ideal, lag_s: 0.1}"),
      "simulation.vehicle.lag_s", "has no meaning");
  add("a delay that nobody can make up for",
      but("{model: first_order_lag, lag_s: 0.1}", "{model: first_order_lag, lag_s: 0.1, command_delay_s: 3}"),
      "simulation.vehicle.command_delay_s", "at most 2 s in all");
  add("a lag for a recorded vehicle", but("{model: first_order_lag, lag_s: 0.1}", "{model: crazyflie, lag_s: 0.1}"),
      "simulation.vehicle.lag_s", "has no meaning for the model `crazyflie`");
  add("an acceleration limit for a recorded vehicle",
      but("{model: first_order_lag, lag_s: 0.1}", "{model: px4, acceleration_limit_m_s2: 2}"),
      "simulation.vehicle.acceleration_limit_m_s2", "has no meaning for the model `px4`");
  add("gusts for the ideal vehicle",
      but("{model: first_order_lag, lag_s: 0.1}", "{model: ideal}\n  wind: {gust_m_s: 1}"), "simulation.wind.gust_m_s",
      "has no meaning for the model `ideal`");
  add("a wind for the ideal vehicle",
      but("{model: first_order_lag, lag_s: 0.1}", "{model: ideal}\n  wind: {mean_m_s: [1, 0]}"),
      "simulation.wind.mean_m_s", "feels no push");
  add("bursts too short for their loss", but("duration_s: 60", "duration_s: 60\n  link: {loss: 0.9, burst_packets: 3}"),
      "simulation.link.burst_packets", "must be at least loss / (1 - loss), 9 packets");
  add("satellites that confuse bodies",
      but("duration_s: 60", "duration_s: 60\n  tracker: {over_link: true, swaps_per_h: 2}"),
      "simulation.tracker.swaps_per_h", "must be left out with `over_link: true`");
  add("no lag for the lagging vehicle", but(", lag_s: 0.1}", "}"), "simulation.vehicle.lag_s", "must be above 0 s");
  add("flying below the landed height", but("{model: first", "{altitude_m: 0.05, model: first"),
      "health.landed_height_m", "must be below simulation.vehicle.altitude_m");
  add("a field like a ribbon", but("[4, 3]", "[400, 3]"), "field.size_m", "ratio of at most 50");
  add("a spread that no grid resolves", but("targets:", "targets:\n  sigma_min_m: 0.001"), "targets.sigma_min_m",
      "must be at least");
  add("a spread wider than the field", but("targets:", "targets:\n  sigma_min_m: 4.5"), "targets.sigma_min_m",
      "must be in [0.00390625, 4] m");
  add("less than one tick", but("duration_s: 60", "duration_s: 1e-9"), "simulation.duration_s",
      "= 1e-9: is shorter than one tick; must be in [0.02, 1000000] s");
  add("a target outside the field", but("[0.2, 1.1]", "[0.2, 1.6]"), "targets.clusters[0].points_m[1]",
      "is outside the field; must be inside the field of 4 m x 3 m");
  add("a target in a no-fly polygon", but("[0.2, 1.1]", "[-1.2, 0.6]"), "targets.clusters[0].points_m[1]",
      "in the no-fly polygon mast");
  add("an area outside the field", but("[[1, -1], [1.5, -1], [1.5, -0.5]]", "[[11, -1], [12, -1], [12, 0]]"),
      "targets.areas[0].outline_m", "must overlap the field");
  add("an area under a no-fly polygon",
      but("[[1, -1], [1.5, -1], [1.5, -0.5]]", "[[-1.3, 0.5], [-1.1, 0.5], [-1.1, 0.7]]"), "targets.areas[0].outline_m",
      "next to nothing");
  add("an area that crosses itself",
      but("[[1, -1], [1.5, -1], [1.5, -0.5]]", "[[1, -1], [1.5, -0.5], [1.5, -1], [1, -0.5]]"),
      "targets.areas[0].outline_m", "does not cross itself");
  add("a no-fly polygon outside the field",
      but("[[-1.4, 0.4], [-1, 0.4], [-1, 0.8], [-1.4, 0.8]]", "[[9, 9], [10, 9], [10, 10]]"), "no_fly[0].outline_m",
      "must overlap the field");
  add("a no-fly polygon without an area",
      but("[[-1.4, 0.4], [-1, 0.4], [-1, 0.8], [-1.4, 0.8]]", "[[0, 0], [1, 1], [0.5, 0.5]]"), "no_fly[0].outline_m",
      "encloses nothing");
  add("no room to fly", but("[[-1.4, 0.4], [-1, 0.4], [-1, 0.8], [-1.4, 0.8]]", "[[-9, -9], [9, -9], [9, 9], [-9, 9]]"),
      "no_fly", "covers the whole field");
  add("two clusters of one name", but("clusters:", "clusters:\n    - {name: north, points_m: [[1, 1]]}"),
      "targets.clusters[1].name", "is also the name of targets.clusters[0]");
  add("an area with a cluster's name", but("name: corner", "name: north"), "targets.areas[0].name",
      "is also the name of");
  add("two no-fly polygons of one name",
      but("no_fly:", "no_fly:\n  - {name: mast, outline_m: [[1, 1], [1.2, 1], [1, 1.2]]}"), "no_fly[1].name",
      "is also the name of no_fly[0]");
  add("duplicate ids", but("{id: b", "{id: a"), "drones[1].id", "is also the id of drones[0]");
  add("a drone called all", but("{id: a", "{id: all"), "drones[0].id", "must be another word");
  add("a start outside the field", but("[-1, -1]", "[-3, -1]"), "drones[0].start_m", "is outside the field");
  add("a start at the wall", but("[-1, -1]", "[-1.95, -1]"), "drones[0].start_m", "is 0.05 m from the field's border");
  add("a start in a no-fly polygon", but("[-1, -1]", "[-1.2, 0.6]"), "drones[0].start_m", "no-fly polygon mast");
  add("a start near a no-fly polygon", but("[-1, -1]", "[-0.95, 0.6]"), "drones[0].start_m", "at least 0.1 m from it");
  add("overlapping starts", but("[0, 0]", "[-1, -0.9]"), "drones[1].start_m", "is 0.1 m from the start of a");
  add("starts inside R though outside R_s", but("[0, 0]", "[-1, -0.7998]"), "drones[1].start_m", "at least 0.200449 m");
  add("more drones than the field holds",
      but("drones:\n  - {id: a, start_m: [-1, -1]}\n  - {id: b, start_m: [0, 0]}\n", "drone_grid: {count: 1000}\n"),
      "drone_grid.count", "must be at most 234");
  add("a grid narrower than R",
      but("drones:\n  - {id: a, start_m: [-1, -1]}\n  - {id: b, start_m: [0, 0]}\n",
          "drone_grid: {count: 2, spacing_m: 0.2002}\n"),
      "drone_grid.spacing_m", "must be at least 0.200449 m");
  add("an event for an unknown drone", but("drone: b", "drone: c"), "simulation.events[0].drone",
      "is no drone of this mission");
  add("a drone exchanged with itself", but("do: land, drone: b", "do: swap_tracking, drone: b, other: b, for_s: 2"),
      "simulation.events[0].other", "must be the id of a drone that is not b");
  add("all drones exchanged with one", but("do: land, drone: b", "do: swap_tracking, drone: all, other: b, for_s: 2"),
      "simulation.events[0].drone", "must be the id of one drone");
  add("an event after the end", but("at_s: 30", "at_s: 61"), "simulation.events[2].at_s", "must be in [0, 60] s");
  add("events out of order", but("at_s: 20", "at_s: 5"), "simulation.events[1].at_s", "must be in the order of time");
  add("an event for an unknown cluster", but("move_target, cluster: west", "move_target, cluster: south"),
      "simulation.events[2].cluster", "is no cluster at that time");
  add("an event for a target that is not there", but("target: 1", "target: 2"), "simulation.events[2].target",
      "must be in [1, 1]");
  add("an event's target outside the field", but("[-1.5, 0]", "[-2.5, 0]"), "simulation.events[1].point_m",
      "is outside the field");
  add("a target added to an area", but("cluster: west, point_m: [-1.5, 0]", "cluster: corner, point_m: [-1.5, 0]"),
      "simulation.events[1].cluster", "is the name of an area");
}

}  // namespace

std::string right_mission() { return std::string(kRight); }

std::string right_mission_but(std::string_view found, std::string_view replacement) {
  std::string text(kRight);
  const std::size_t at = text.find(found);
  if (at == std::string::npos) throw std::logic_error("not in the right mission: " + std::string(found));
  return text.replace(at, found.size(), replacement);
}

std::vector<MalformedMission> malformed_missions() {
  std::vector<MalformedMission> table;
  add_broken_texts(table);
  add_broken_structures(table);
  add_contradictions(table);
  return table;
}

}  // namespace vigil::runtime
