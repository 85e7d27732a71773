#include "vigil/apps/serve_command.hpp"

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/server.hpp"
#include "vigil/adapters/recording/bag_recorder.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/apps/flown_drones.hpp"
#include "vigil/apps/interrupt.hpp"
#include "vigil/apps/mission_choice.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/apps/ros_side.hpp"
#include "vigil/apps/thread_choice.hpp"
#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/event_words.hpp"
#include "vigil/runtime/live_mission.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/saved_flight.hpp"
#include "vigil/runtime/thread_priority.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

void check_options(const ServeOptions& options) {
  if (options.fleet != "sim" && options.fleet != "ros")
    throw Failure(kBadInput, fmt::format("--fleet {}: is not known; must be: sim (simulated drones), ros (Crazyswarm)",
                                         runtime::on_one_line(options.fleet, 60)));
  check_console(options.console);
  if (!console::role_of(options.ros_role))
    throw Failure(kBadInput, fmt::format("--ros-role {}: is not known; must be: viewer, operator",
                                         runtime::on_one_line(options.ros_role, 60)));
}

/// Of each mission that one program flies a folder: DIR, DIR-2, ...
fs::path recording_of(const fs::path& folder, std::uint32_t epoch) {
  return epoch == 1 ? folder : fs::path(fmt::format("{}-{}", folder.string(), epoch));
}

std::chrono::nanoseconds time_of_day() { return std::chrono::system_clock::now().time_since_epoch(); }

std::unique_ptr<runtime::QueuedRecorder> recorder_for(const runtime::Mission& mission, const ServeOptions& options,
                                                      const runtime::FlightStart& start, std::uint32_t epoch) {
  if (options.record.empty()) return nullptr;
  const fs::path folder = recording_of(options.record, epoch);
  refuse_existing("--record", folder);
  recording::BagRecorderOptions how = recorder_options(options.recording);
  how.time_of_day = time_of_day;
  how.bag.must_survive_power = true;
  auto recorder = std::make_unique<recording::BagRecorder>(folder, runtime::mission_yaml(mission), how);
  return std::make_unique<runtime::QueuedRecorder>(std::move(recorder), mission, start);
}

std::vector<DroneStart> starts_of(const runtime::SavedFlight& saved) {
  std::vector<DroneStart> starts;
  for (const runtime::SavedFlight::Drone& drone : saved.drones) {
    const bool has_no_motors = drone.order == swarm::Intent::kEmergencyStop;
    starts.push_back({drone.place_m, drone.is_down || has_no_motors});
  }
  return starts;
}

std::vector<swarm::Intent> standing_of(const runtime::SavedFlight& saved) {
  std::vector<swarm::Intent> standing;
  for (const runtime::SavedFlight::Drone& drone : saved.drones) standing.push_back(drone.order);
  return standing;
}

/// They have the control thread's priority; none where it would be alone.
std::unique_ptr<parallel::Workers> workers_for(const runtime::Mission& mission, const ServeOptions& options) {
  const std::size_t threads = threads_for(mission.drones.size(), options.threads);
  std::unique_ptr<parallel::Workers> workers;
  if (threads > 1)
    runtime::start_with_real_time_priority([&] { workers = std::make_unique<parallel::Workers>(threads); });
  return workers;
}

/// `saved`: what an earlier run left, or null. `ros`: there where the fleet is "ros".
std::shared_ptr<runtime::LiveMission> make_flight(const runtime::Mission& mission, const ServeOptions& options,
                                                  std::uint32_t epoch, const runtime::SavedFlight* saved,
                                                  RosSide* ros) {
  runtime::FlightStart start{runtime::first_intent(mission), {}};
  // After a restart the drones hover until somebody has looked, and resumes.
  if (saved != nullptr) start.first_intent = swarm::Intent::kHold;
  if (saved != nullptr) start.standing = standing_of(*saved);
  if (saved != nullptr && saved->past.ticks > 0) start.past = saved->past;
  std::unique_ptr<parallel::Workers> workers = workers_for(mission, options);
  if (options.fleet == "ros") {
    // What stands there stays down until somebody lets it take off; what is in the air is somebody else's.
    if (saved == nullptr) start.first_intent = swarm::Intent::kStayDown;
    start.has_real_drones = true;
    auto fleet = crazyswarm_fleet(mission, options.ros_tf, [ros](const std::string& text) { ros->warn(text); });
    return std::make_shared<runtime::LiveMission>(mission, std::move(fleet), nullptr,
                                                  recorder_for(mission, options, start, epoch), start, epoch,
                                                  runtime::drive_in_real_time, std::move(workers));
  }
  std::unique_ptr<runtime::VirtualFleet> fleet = saved == nullptr
                                                     ? simulated_fleet(mission, workers.get())
                                                     : simulated_fleet(mission, starts_of(*saved), workers.get());
  runtime::VirtualFleet* const world = fleet.get();
  return std::make_shared<runtime::LiveMission>(mission, std::move(fleet), world,
                                                recorder_for(mission, options, start, epoch), start, epoch,
                                                runtime::drive_in_real_time, std::move(workers));
}

/// A new mission's fleet knows nothing of drones that the old one's flies: they would be nobody's.
void refuse_in_flight(const FlownDrones& flown) {
  if (flown.are_in_the_air())
    throw Failure(kBadInput, "drones of Crazyswarm are in the air; land them before another mission is loaded");
}

/// Of simulated drones nothing is left to land.
bool may_end(FlownDrones& flown, const ServeOptions& options) {
  if (!is_interrupted() || options.fleet != "ros") return is_interrupted();
  return flown.are_down([] {
    fmt::print(
        "vigil: lands all drones, and ends once they are seen on the ground; a second Ctrl-C ends it at once, and "
        "what is in the air then levels after half a second and falls after two\n");
    std::fflush(stdout);
  });
}

/// Why a folder is refused that keeps a flight of something else. What keeps what was flown comes first.
std::string of_another_mission(const runtime::FlightStore& store, const runtime::SavedFlight& saved,
                               const runtime::Mission& mission) {
  const std::string folder = in_words(store.folder());
  const std::string kept = runtime::parse_mission(saved.mission_text, folder).name;
  const std::string how = kept == mission.name ? ", as its file was before it was changed" : "";
  return fmt::format(
      "--state {}: keeps a flight of the mission {}{}; give the file of that one to go on with it, or another folder "
      "for the mission {}; --afresh would throw away what was flown",
      folder, kept, how, mission.name);
}

/// What an earlier run left of the same mission; nothing where it left nothing.
std::optional<runtime::SavedFlight> left_by_an_earlier_run(const runtime::FlightStore& store,
                                                           const runtime::Mission& mission) {
  std::optional<runtime::SavedFlight> saved = store.load();
  if (!saved) return std::nullopt;
  if (saved->mission_text != runtime::mission_yaml(mission) || saved->drones.size() != mission.drones.size())
    throw Failure(kBadInput, of_another_mission(store, *saved, mission));
  return saved;
}

/// Whether the system will give the control thread real-time priority: a thread of its own tries.
bool ticks_may_come_first() {
  bool may = false;
  std::thread([&may] { may = runtime::take_real_time_priority(); }).join();
  return may;
}

void announce(const ServeOptions& options, const std::string& mission, const std::string& url, bool is_restored) {
  fmt::print("vigil: {} at {}\n", mission, url);
  warn_of_readers(options.console);
  if (!ticks_may_come_first())
    fmt::print("vigil: without real-time priority ticks begin late on a busy machine; `ulimit -r 1` would allow it\n");
  if (is_restored) fmt::print("vigil: goes on where it was; {}\n", runtime::after_restart(options.fleet == "ros"));
  std::fflush(stdout);
}

int run(const ServeOptions& options, const std::string& version) {
  runtime::Mission mission = choose_mission(options.mission, options.settings);
  std::shared_ptr<runtime::FlightStore> store;
  std::optional<runtime::SavedFlight> saved;
  if (!options.state.empty()) {
    store = std::make_shared<runtime::FlightStore>(options.state);
    if (options.afresh) store->clear();
    saved = left_by_an_earlier_run(*store, mission);
    if (saved) mission = runtime::parse_mission(saved->targets_text, in_words(options.state));
  }
  std::optional<RosSide> ros;
  const bool is_over_ros = options.ros || options.fleet == "ros";
  if (is_over_ros) check_ros_names(mission);
  if (is_over_ros) ros.emplace(*console::role_of(options.ros_role));
  console::ServerOptions served = server_options(options.console, version);
  served.recording_folder = options.record.string();
  if (ros) served.overhear = [&ros](const console::DeskNews& news) { ros->overhear(news); };
  std::string url;
  served.ready = [&] { announce(options, mission.name, url, saved.has_value()); };
  FlownDrones flown;
  console::Server server(
      served,
      [&options, &ros, &flown](const runtime::Mission& one, std::uint32_t epoch, const runtime::SavedFlight* of) {
        if (ros) check_ros_names(one);
        if (options.fleet == "ros") refuse_in_flight(flown);
        auto flight = make_flight(one, options, epoch, of, ros ? &*ros : nullptr);
        flown.watch(flight);
        return flight;
      },
      store);
  url = server.url();
  catch_interrupts();
  if (ros) ros->attach(server);
  server.run(mission, saved ? &*saved : nullptr, [&] { return may_end(flown, options); });
  if (ros) ros->release();
  return kDone;
}

}  // namespace

int serve(const ServeOptions& options, const std::string& version) {
  check_options(options);
  try {
    return run(options, version);
  } catch (const console::SetupError& error) {
    throw Failure(kBadInput, error.what());
  } catch (const ros_bridge::RosError& error) {
    throw Failure(kComponentFailed, error.what());
  } catch (const runtime::SavedFlightError& error) {
    throw Failure(kComponentFailed, error.what());
  }
}

}  // namespace vigil::apps
