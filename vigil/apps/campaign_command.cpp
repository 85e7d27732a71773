#include "vigil/apps/campaign_command.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/adapters/mpi/mpi_team.hpp"
#include "vigil/apps/campaign_folder.hpp"
#include "vigil/apps/campaign_workers.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/fleet_choice.hpp"
#include "vigil/apps/interrupt.hpp"
#include "vigil/apps/mission_choice.hpp"
#include "vigil/apps/progress_bar.hpp"
#include "vigil/runtime/campaign_tally.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/mission_writer.hpp"
#include "vigil/runtime/virtual_flight.hpp"

namespace vigil::apps {
namespace {

using Json = nlohmann::ordered_json;

/// Between two looks at the other processes, at the progress and at Ctrl-C.
constexpr std::chrono::milliseconds kPatience{20};

/// What a process of a team hands in when it has flown its share.
const std::string kFarewell;

/// Finds out before anything is written whether the variations can be drawn at all.
runtime::CampaignPlan plan_of(const CampaignOptions& options) {
  runtime::CampaignPlan plan;
  plan.mission_yaml = runtime::mission_yaml(
      choose_mission(options.mission, options.settings, {.seconds = options.seconds, .seed = std::nullopt}));
  for (const std::string& text : options.vary) plan.variations.push_back(runtime::parse_variation(text));
  plan.seed = options.seed;
  plan.runs = options.runs;
  static_cast<void>(runtime::draw_run(plan, 0));
  return plan;
}

std::chrono::nanoseconds now() { return std::chrono::steady_clock::now().time_since_epoch(); }

std::string fly(const runtime::CampaignPlan& plan, std::uint64_t number, const std::string& folder) {
  const runtime::CampaignRun run = runtime::draw_run(plan, number);
  const std::unique_ptr<runtime::VirtualFleet> fleet = simulated_fleet(run.mission);
  runtime::VirtualFlight flight(run.mission, *fleet, nullptr, now);
  while (!flight.is_over()) flight.step();
  return runtime::record_line(run, runtime::repeat_command(run, folder), flight.summary());
}

/// The cores that this process may use, shared with those of its team on this machine.
unsigned threads_of(const CampaignOptions& options, const runtime::CampaignTeam* team) {
  if (options.threads > 0) return options.threads;
  const unsigned allowed = std::max(1U, std::thread::hardware_concurrency());
  if (team == nullptr) return allowed;
  const auto share = static_cast<std::size_t>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN))) / team->size_here();
  return std::clamp(static_cast<unsigned>(share), 1U, allowed);
}

/// Every n-th of the runs, from the one of this process on.
std::vector<std::uint64_t> share_of(const std::vector<std::uint64_t>& runs, const runtime::CampaignTeam* team) {
  if (team == nullptr) return runs;
  std::vector<std::uint64_t> share;
  for (std::size_t i = team->rank(); i < runs.size(); i += team->size()) share.push_back(runs[i]);
  return share;
}

CampaignWorkers begin(const CampaignOptions& options, const runtime::CampaignPlan& plan,
                      const std::vector<std::uint64_t>& runs, const runtime::CampaignTeam* team) {
  return {share_of(runs, team), threads_of(options, team),
          [&plan, folder = options.out.string()](std::uint64_t run) { return fly(plan, run, folder); }};
}

/// The one process that keeps what was flown, by itself or by its team.
class Leader {
 public:
  Leader(const CampaignOptions& options, runtime::CampaignTeam* team)
      : options_(options),
        team_(team),
        plan_(plan_of(options)),
        folder_(options.out, plan_, [this](const runtime::RunRecord& record) { tally_.add(record); }) {}

  int lead() {
    const std::vector<std::uint64_t> missing = folder_.missing();
    if (team_ != nullptr)
      static_cast<void>(team_->share(Json{{"plan", runtime::plan_json(plan_)}, {"runs", missing}}.dump()));
    fly_and_collect(missing);
    if (team_ != nullptr) team_->part();
    return finish();
  }

 private:
  void fly_and_collect(const std::vector<std::uint64_t>& missing) {
    CampaignWorkers workers = begin(options_, plan_, missing, team_);
    ProgressBar progress("campaign");
    std::size_t others = team_ == nullptr ? 0 : team_->size() - 1;
    while (!workers.is_over() || others > 0) {
      if (is_interrupted()) workers.stop();
      if (const std::optional<std::string> line = workers.next_line(kPatience)) keep(*line);
      others -= collect_from_others();
      const double share = static_cast<double>(kept_) / static_cast<double>(std::max<std::size_t>(1, missing.size()));
      progress.show(share, fmt::format("run {} of {}: {}", tally_.runs(), plan_.runs, tally_.worst_so_far()));
    }
  }

  /// How many said farewell.
  std::size_t collect_from_others() {
    std::size_t farewells = 0;
    if (team_ == nullptr) return farewells;
    while (const std::optional<std::string> line = team_->take()) {
      if (*line == kFarewell)
        ++farewells;
      else
        keep(*line);
    }
    return farewells;
  }

  void keep(const std::string& line) {
    folder_.append(line);
    ++kept_;
    if (const std::optional<runtime::RunRecord> record = runtime::parse_record(line)) tally_.add(*record);
  }

  [[nodiscard]] Json summary() const {
    Json vary = Json::array();
    for (const runtime::Variation& variation : plan_.variations) vary.push_back(variation.text);
    Json summary{{"mission", options_.mission.string()},
                 {"seed", plan_.seed},
                 {"vary", vary},
                 {"runs", plan_.runs},
                 {"complete", tally_.runs() == plan_.runs}};
    summary.update(tally_.to_json());
    return summary;
  }

  int finish() {
    const std::string text = summary().dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    folder_.write_summary(text);
    if (options_.json)
      std::fputs(text.c_str(), stdout);
    else
      print_for_people();
    if (tally_.runs() == plan_.runs) return tally_.violating_runs() == 0 ? kDone : kCheckFailed;
    fmt::print(stderr, "vigil: stopped after {} of {} runs; the same command goes on with the others\n", tally_.runs(),
               plan_.runs);
    return kInterrupted;
  }

  void print_for_people() const {
    fmt::print("{}: {} of {} runs\n{}", options_.mission.string(), tally_.runs(), plan_.runs, tally_.table());
    fmt::print("  written to {}: each line of runs.jsonl has the command that repeats the run\n",
               options_.out.string());
  }

  const CampaignOptions& options_;
  runtime::CampaignTeam* team_;
  runtime::CampaignPlan plan_;
  runtime::CampaignTally tally_;
  CampaignFolder folder_;
  std::size_t kept_ = 0;
};

/// Any other process of a team: flies its share and hands in the lines.
int follow(const CampaignOptions& options, runtime::CampaignTeam& team) {
  const Json order = Json::parse(team.share({}));
  const runtime::CampaignPlan plan = runtime::parse_plan(order.at("plan").get<std::string>(), "the leader's plan");
  CampaignWorkers workers = begin(options, plan, order.at("runs").get<std::vector<std::uint64_t>>(), &team);
  while (!workers.is_over()) {
    if (is_interrupted()) workers.stop();
    if (const std::optional<std::string> line = workers.next_line(kPatience)) team.hand_in(*line);
  }
  team.hand_in(kFarewell);
  team.part();
  return kDone;
}

/// The exit code for what went wrong, told on stderr as main() would tell it.
int tell(const std::exception& error) {
  fmt::print(stderr, "vigil: {}\n", error.what());
  if (const auto* failure = dynamic_cast<const Failure*>(&error)) return failure->code();
  return dynamic_cast<const runtime::MissionError*>(&error) != nullptr ? kBadInput : kComponentFailed;
}

/// A process that fails takes the others with it: they would wait for it for ever.
int campaign_in_team(const CampaignOptions& options) {
  const std::unique_ptr<runtime::CampaignTeam> team = mpi::join_team();
  int exit_code = kComponentFailed;
  try {
    return team->rank() == 0 ? Leader(options, team.get()).lead() : follow(options, *team);
  } catch (const std::exception& error) {
    exit_code = tell(error);
  }
  team->abandon(exit_code);
  return exit_code;
}

}  // namespace

int campaign(const CampaignOptions& options) {
  catch_interrupts();
  return options.mpi ? campaign_in_team(options) : Leader(options, nullptr).lead();
}

}  // namespace vigil::apps
