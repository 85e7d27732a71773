#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/apps/campaign_command.hpp"
#include "vigil/apps/check_command.hpp"
#include "vigil/apps/console_options.hpp"
#include "vigil/apps/export_command.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/laboratory_command.hpp"
#include "vigil/apps/margins_command.hpp"
#include "vigil/apps/replay_command.hpp"
#include "vigil/apps/report_command.hpp"
#include "vigil/apps/serve_command.hpp"
#include "vigil/apps/simulate_command.hpp"
#include "vigil/core/parallel/workers.hpp"
#include "vigil/runtime/mission_error.hpp"

namespace vigil::apps {
namespace {

/// What the command line asks for. Parsed once, handed to exactly one command.
struct Arguments {
  SimulateOptions simulate;
  CampaignOptions campaign;
  CheckOptions check;
  MarginsOptions margins;
  ReplayOptions replay;
  ExportOptions export_of;
  ReportArguments report;
  ServeOptions serve;
  LaboratoryOptions laboratory;
};

void add_settings(CLI::App* command, std::vector<std::string>& settings) {
  command->add_option("--set", settings, "Change a value of the mission: key=value, e.g. control.accounting=paper_eq14")
      ->type_name("KEY=VALUE")
      ->take_all();
}

void add_recording_options(CLI::App* command, RecordingOptions& options) {
  constexpr std::uint64_t kMostMib = std::uint64_t{1} << 24U;
  command->add_option("--record-every", options.keep_every, "Keep every Nth tick in the recording")
      ->check(CLI::Range(1, 1'000'000));
  command
      ->add_option("--record-split", options.split_mib, "Begin another file of the recording at so many MiB (0: never)")
      ->check(CLI::Range(std::uint64_t{0}, kMostMib));
  command->add_option("--record-keep-free", options.keep_free_mib, "Record no more where the disk has fewer MiB left")
      ->check(CLI::Range(std::uint64_t{0}, kMostMib));
}

void add_threads(CLI::App* command, std::size_t& threads) {
  command
      ->add_option("--threads", threads,
                   "How many threads share a tick (default: one for every thousand drones, as far as there are cores); "
                   "the flight is the same to the last bit")
      ->check(CLI::Range(std::size_t{1}, parallel::kMostThreads));
}

/// A footer of a command's help: what its exit tells, in the order of the codes.
std::string exit_codes(std::string_view failed_check, bool can_be_interrupted) {
  return fmt::format("Exit codes: 0 done, {}2 bad arguments or mission file, 3 a component is missing or failed{}.",
                     failed_check, can_be_interrupted ? ", 130 interrupted: what was done is kept" : "");
}

CLI::Validator not_empty() {
  return {[](const std::string& text) { return text.empty() ? std::string("has no value") : std::string(); }, ""};
}

/// Without it, -1 would be taken for the highest of all seeds.
CLI::Validator not_negative() {
  return {[](const std::string& text) {
            return text.starts_with('-') ? text + " is below 0; give a whole number from 0 on" : std::string();
          },
          ""};
}

CLI::App* add_simulate(CLI::App& program, SimulateOptions& options) {
  CLI::App* command = program.add_subcommand("simulate", "Fly a mission in the simulator, as fast as it can");
  command->add_option("MISSION", options.mission, "The mission file (YAML)")->required();
  command->add_option("--out", options.out, "Directory for recording/ and summary.json; must not exist")
      ->required()
      ->check(not_empty());
  command->add_option("--seconds", options.shorthands.seconds, "How long to fly instead of what the mission says")
      ->type_name("NUMBER");
  command->add_option("--seed", options.shorthands.seed, "The seed of everything random instead of the mission's")
      ->type_name("NUMBER");
  add_recording_options(command, options.recording);
  add_threads(command, options.threads);
  command->add_flag("--json", options.json, "Print summary.json instead of a text");
  add_settings(command, options.settings);
  command->footer(exit_codes("", true));
  return command;
}

CLI::App* add_campaign(CLI::App& program, CampaignOptions& options) {
  CLI::App* command =
      program.add_subcommand("campaign", "Fly a mission many times, each time a little different, and judge the runs");
  command->add_option("MISSION", options.mission, "The mission file (YAML)")->required();
  command->add_option("--runs", options.runs, "How many runs")->required()->check(CLI::Range(1, 10'000'000));
  command
      ->add_option("--out", options.out,
                   "Directory for plan.json, runs.jsonl and summary.json; the same command goes on there")
      ->required()
      ->check(not_empty());
  command->add_option("--seed", options.seed, "The seed of the campaign: which runs it has (default 1)")
      ->check(not_negative());
  command->add_option("--seconds", options.seconds, "How long to fly instead of what the mission says")
      ->type_name("NUMBER");
  command
      ->add_option("--vary", options.vary,
                   "What differs from run to run beside the seed: starts, targets, faults[=N], key=a..b, key=a|b|c")
      ->type_name("WHAT")
      ->take_all();
  command->add_option("--threads", options.threads, "Runs at a time (default: one a core)")->check(CLI::Range(1, 1024));
  command->add_flag("--json", options.json, "Print summary.json instead of a table");
  command->add_flag("--mpi", options.mpi, "Share the runs with the other processes that mpirun started");
  add_settings(command, options.settings);
  command->footer(exit_codes("1 a run broke a rule, ", true));
  return command;
}

CLI::App* add_check(CLI::App& program, CheckOptions& options) {
  CLI::App* command = program.add_subcommand("check", "Validate a mission file and explain what it means");
  command->add_option("MISSION", options.mission, "The mission file (YAML)")->required();
  command->add_flag("--json", options.json, "Print JSON instead of a text");
  add_settings(command, options.settings);
  command->footer(exit_codes("", false));
  return command;
}

CLI::App* add_margins(CLI::App& program, MarginsOptions& options) {
  CLI::App* command =
      program.add_subcommand("margins", "Compute what lag, gains and margins a mission's vehicles need, and what of");
  command->add_option("MISSION", options.mission, "The mission file (YAML)")->required();
  command->add_flag("--json", options.json, "Print JSON instead of a text");
  add_settings(command, options.settings);
  command->footer(exit_codes("", false));
  return command;
}

CLI::App* add_report(CLI::App& program, ReportArguments& arguments) {
  CLI::App* command = program.add_subcommand("report", "Draw the figures of a recording (SVG and PNG) and report.html");
  command->add_option("DIR", arguments.directory, "The directory that simulate or serve --record wrote")->required();
  command->footer(exit_codes("", false));
  return command;
}

void add_console_options(CLI::App* command, ConsoleOptions& options) {
  command->add_option("--port", options.port, "Where the console is served (default 8080; 0: any free port)");
  command->add_option("--address", options.address,
                      "The address to listen at (default 127.0.0.1: this machine only); others need --tokens");
  command->add_option("--name", options.names, "Another name by which browsers come here, e.g. base.example.org")
      ->take_all();
  command->add_option("--tokens", options.tokens, "File of lines `ROLE TOKEN`: viewer, operator, safety_pilot")
      ->check(not_empty());
  command->add_option("--certificate", options.certificate, "Serve by TLS with this certificate (PEM)")
      ->check(not_empty());
  command->add_option("--key", options.key, "The certificate's key (PEM)")->check(not_empty());
  command->add_option("--page", options.page, "Folder of the console's page instead of the built one")
      ->check(not_empty());
}

CLI::App* add_replay(CLI::App& program, ReplayOptions& options) {
  CLI::App* command =
      program.add_subcommand("replay", "Look at a recording in the console, or fly it again from what it was given");
  command->add_option("DIR", options.directory, "The directory that simulate or serve --record wrote")->required();
  command->add_flag("--verify", options.verify, "Recompute every tick and compare it, bit for bit");
  command->add_option("--from", options.from_s, "Fly on from this moment by other rules, in the mission's simulator")
      ->type_name("SECONDS");
  command->add_option("--why", options.why, "Why this drone's velocity was what it was: what was wanted, every row")
      ->type_name("DRONE");
  command->add_option("--at", options.at_s, "The moment of --why (default: the end)")->type_name("SECONDS");
  command->add_option("--out", options.out, "Directory for a recording of the flight that would have been")
      ->check(not_empty());
  add_settings(command, options.settings);
  const std::size_t others = command->get_options().size();
  add_console_options(command, options.console);
  const std::vector<CLI::Option*> all = command->get_options();
  for (std::size_t i = others; i < all.size(); ++i)
    all[i]->each([&options](const std::string&) { options.asks_for_console = true; });
  command->add_flag("--json", options.json, "Print JSON instead of a text");
  command->footer(exit_codes("1 a tick differs or cannot be recomputed, ", false));
  return command;
}

CLI::App* add_export(CLI::App& program, ExportOptions& options) {
  CLI::App* command = program.add_subcommand(
      "export", "Write a recording as tables (CSV), and as maps (GeoJSON, KML) where its mission has a datum");
  command->add_option("DIR", options.directory, "The directory that simulate or serve --record wrote")->required();
  command->add_option("--out", options.out, "Directory for the files; must not exist")->required()->check(not_empty());
  command
      ->add_option("--track-step", options.track_step_s,
                   "Seconds between the points of a drone's track on maps (default 1)")
      ->check(CLI::Range(0.001, 86400.0));
  command->footer(exit_codes("", false));
  return command;
}

CLI::App* add_serve(CLI::App& program, ServeOptions& options) {
  CLI::App* command = program.add_subcommand("serve", "Fly a mission in real time, with the operator's console");
  command->add_option("MISSION", options.mission, "The mission file (YAML)")->required();
  command->add_option("--fleet", options.fleet,
                      "Which drones: sim (simulated, the default), ros (Crazyswarm over ROS 1; implies --ros)");
  add_console_options(command, options.console);
  command->add_option("--record", options.record, "Directory for a recording; must not exist")->check(not_empty());
  add_recording_options(command, options.recording);
  add_threads(command, options.threads);
  command->add_option("--state", options.state, "Directory from which a restarted program goes on where it was")
      ->check(not_empty());
  command->add_flag("--afresh", options.afresh, "Forget what an earlier run left in --state");
  command->add_flag("--ros", options.ros, "Show it over ROS 1 (RViz) as well, and take targets from there");
  command->add_flag("--ros-tf", options.ros_tf, "With --fleet ros: positions from /tf instead of vicon_bridge");
  command->add_option("--ros-role", options.ros_role,
                      "What may be asked for over ROS: viewer (nothing), operator (the default)");
  add_settings(command, options.settings);
  command->footer(
      "Exit codes: 0 ended by Ctrl-C, 2 bad arguments or mission file, 3 a component is missing or failed.");
  return command;
}

CLI::App* add_laboratory(CLI::App& program, LaboratoryOptions& options) {
  CLI::App* command = program.add_subcommand(
      "laboratory",
      "Stand in for Crazyswarm and vicon_bridge over ROS 1, with simulated drones, for serve --fleet ros");
  command->add_option("MISSION", options.mission, "The mission file (YAML) that is served")->required();
  command->add_option("--only", options.only, "One of the two nodes: crazyswarm, vicon");
  command->add_option("--out", options.out, "File for the judgement of what the drones really did")->check(not_empty());
  add_settings(command, options.settings);
  command->footer(
      "Exit codes: 0 ended by Ctrl-C, 2 bad arguments or mission file, 3 a component is missing or failed.");
  return command;
}

int run(int argc, char** argv) {
  CLI::App program("A drone swarm that persistently monitors what people point at.", "vigil");
  program.set_version_flag("--version", "vigil " VIGIL_VERSION);
  program.require_subcommand(0, 1);
  Arguments arguments;
  const CLI::App* simulate_command = add_simulate(program, arguments.simulate);
  const CLI::App* campaign_command = add_campaign(program, arguments.campaign);
  const CLI::App* check_command = add_check(program, arguments.check);
  const CLI::App* margins_command = add_margins(program, arguments.margins);
  const CLI::App* report_command = add_report(program, arguments.report);
  const CLI::App* replay_command = add_replay(program, arguments.replay);
  const CLI::App* export_command = add_export(program, arguments.export_of);
  const CLI::App* serve_command = add_serve(program, arguments.serve);
  const CLI::App* laboratory_command = add_laboratory(program, arguments.laboratory);
  const CLI::App* schema_command =
      program.add_subcommand("schema", "Print the JSON Schema of mission files, for editors");
  program.footer(exit_codes("1 a run of a campaign broke a rule, ", true) +
                 "\nStart with: ./run simulate missions/paper.yaml --out out/paper && ./run report out/paper");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);
    throw Failure(kBadInput,
                  fmt::format("{}; `vigil --help` and `vigil COMMAND --help` list what there is", error.what()));
  }
  if (simulate_command->parsed()) return simulate(arguments.simulate);
  if (campaign_command->parsed()) return campaign(arguments.campaign);
  if (check_command->parsed()) return check(arguments.check);
  if (margins_command->parsed()) return margins(arguments.margins);
  if (report_command->parsed()) return report(arguments.report);
  if (replay_command->parsed()) return replay(arguments.replay, VIGIL_VERSION);
  if (export_command->parsed()) return export_recording(arguments.export_of);
  if (serve_command->parsed()) return serve(arguments.serve, VIGIL_VERSION);
  if (laboratory_command->parsed()) return laboratory(arguments.laboratory);
  if (schema_command->parsed()) return print_schema();
  std::fputs(program.help().c_str(), stdout);
  return kBadInput;
}

int fail(ExitCode code, std::string_view line) {
  constexpr std::size_t kMostBytes = 4000;
  fmt::print(stderr, "vigil: {}\n", runtime::on_one_line(line, kMostBytes));
  return code;
}

/// Whoever reads standard output must learn that it is not whole, whatever became of the command.
int after_output(int exit_code) {
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  return is_written ? exit_code
                    : fail(kComponentFailed,
                           "standard output could not be written whole; make room where it goes, or send it elsewhere");
}

}  // namespace
}  // namespace vigil::apps

int main(int argc, char** argv) {
  using namespace vigil;
  try {
    return apps::after_output(apps::run(argc, argv));
  } catch (const apps::Failure& failure) {
    return apps::fail(failure.code(), failure.what());
  } catch (const runtime::MissionError& error) {
    return apps::fail(apps::kBadInput, error.what());
  } catch (const recording::RecordingError& error) {
    return apps::fail(apps::kComponentFailed, error.what());
  } catch (const std::bad_alloc&) {
    return apps::fail(apps::kComponentFailed, "out of memory; fly fewer drones or a shorter mission");
  } catch (const std::exception& error) {
    return apps::fail(apps::kComponentFailed, error.what());
  }
}
