// What the swarm notices of every fault on every vehicle, against ground truth: prints the tables of
// docs/fault-matrix.md. What has been flown already is taken from the file; so it can be stopped and started again.
//
//     fault_matrix RESULTS.csv [MOMENTS [HOURS]]

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "vigil/apps/fleet_choice.hpp"
#include "vigil/runtime/fault_trial.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil {
namespace {

using runtime::FaultTrial;
using runtime::Misfortune;
using runtime::Mission;

constexpr std::array<std::string_view, 5> kVehicles{"ideal", "first_order_lag", "crazyflie", "arducopter", "px4"};
constexpr std::size_t kFaults = runtime::kMisfortuneWords.size();
constexpr double kQuietFlightS = 3600.0;
constexpr std::uint64_t kFirstSeed = 90'000;  // of moments that no threshold was looked at with

std::unique_ptr<runtime::VirtualFleet> make_fleet(const Mission& mission) { return apps::simulated_fleet(mission); }

Mission mission_of(std::string_view vehicle, const std::vector<runtime::Override>& overrides = {}) {
  return runtime::load_mission(fmt::format("{}/vehicles/{}.yaml", VIGIL_MISSIONS_DIR, vehicle), overrides);
}

/// As the bar has it: 5 % of the packets lost, each by itself.
Mission quiet_mission_of(std::string_view vehicle) {
  return mission_of(vehicle, {{"simulation.link.loss", "0.05"}, {"simulation.link.burst_packets", "1"}});
}

struct Job {
  std::size_t vehicle = 0;
  std::size_t fault = 0;  ///< kFaults: a flight without one
  std::uint64_t seed = 0;
  [[nodiscard]] std::string key() const { return fmt::format("{},{},{}", vehicle, fault, seed); }
};

std::string fly(const Job& job, const Mission& mission) {
  if (job.fault == kFaults)
    return fmt::format("{},{}", job.key(), runtime::false_alarms(mission, make_fleet, job.seed, kQuietFlightS));
  const FaultTrial t = runtime::fly_trial(mission, make_fleet, static_cast<Misfortune>(job.fault), job.seed);
  return fmt::format("{},{:d},{:d},{:d},{:d},{},{},{},{},{},{},{}", job.key(), t.has_shown, t.is_noticed, t.is_in_time,
                     t.is_named_rightly, t.delay_s, t.false_alarms, t.close_ticks, t.contact_ticks,
                     t.others_violation_ticks, t.unnoticed_s, t.evadable_pairs);
}

using Results = std::map<std::string, std::vector<double>>;

Results read_results(const std::string& path) {
  Results results;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::stringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::strtod(field.c_str(), nullptr));
    const bool is_whole = values.size() == 14 || (values.size() == 4 && values[1] == static_cast<double>(kFaults));
    if (is_whole) results[fmt::format("{},{},{}", values[0], values[1], values[2])] = values;
  }
  return results;
}

std::vector<Job> all_jobs(std::uint64_t moments, std::uint64_t hours) {
  std::vector<Job> jobs;
  for (std::uint64_t seed = 1; seed <= moments; ++seed)
    for (std::size_t vehicle = 0; vehicle < kVehicles.size(); ++vehicle)
      for (std::size_t fault = 0; fault < kFaults; ++fault) jobs.push_back({vehicle, fault, kFirstSeed + seed});
  for (std::uint64_t hour = 1; hour <= hours; ++hour)
    jobs.push_back({(hour - 1) % kVehicles.size(), kFaults, kFirstSeed + hour});
  return jobs;
}

void fly_all(const std::vector<Job>& jobs, const std::string& path) {
  const Results known = read_results(path);
  std::vector<Mission> missions;
  std::vector<Mission> quiet;
  for (const std::string_view vehicle : kVehicles) {
    missions.push_back(mission_of(vehicle));
    quiet.push_back(quiet_mission_of(vehicle));
  }
  std::ofstream file(path, std::ios::app);
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) {
      const Job& job = jobs[i];
      const bool is_known = known.contains(job.key());
      const Mission& mission = job.fault == kFaults ? quiet[job.vehicle] : missions[job.vehicle];
      const std::string line = is_known ? "" : fly(job, mission);
      const std::scoped_lock lock(mutex);
      if (!is_known) file << line << std::endl;
      if (++done % 20 == 0) fmt::print(stderr, "\r{} of {} flights", done, jobs.size());
    }
  };
  std::thread second(work);
  work();
  second.join();
  fmt::print(stderr, "\n");
}

struct Cell {
  std::size_t shown = 0;
  std::size_t trials = 0;
  std::size_t noticed = 0;
  std::size_t in_time = 0;
  std::size_t named = 0;
  double close = 0.0;
  double contact = 0.0;
  double others = 0.0;
  double evadable = 0.0;
  double false_alarms = 0.0;
  std::vector<double> delays;
  std::vector<double> unnoticed;
};

Cell cell_of(const Results& results, std::size_t vehicle, std::size_t fault) {
  Cell cell;
  for (const auto& [key, v] : results) {
    if (v[0] != static_cast<double>(vehicle) || v[1] != static_cast<double>(fault)) continue;
    ++cell.trials;
    cell.false_alarms += v[8];
    cell.close += v[9] > 0.0 ? 1.0 : 0.0;
    cell.contact += v[10] > 0.0 ? 1.0 : 0.0;
    cell.others += v[11] > 0.0 ? 1.0 : 0.0;
    cell.evadable += v[13] > 0.0 ? 1.0 : 0.0;
    if (v[3] == 0.0) continue;
    ++cell.shown;
    cell.noticed += v[4] != 0.0 ? 1U : 0U;
    cell.in_time += v[5] != 0.0 ? 1U : 0U;
    cell.named += v[6] != 0.0 ? 1U : 0U;
    if (v[4] == 0.0) continue;
    cell.delays.push_back(v[7]);
    cell.unnoticed.push_back(v[12]);
  }
  std::ranges::sort(cell.delays);
  std::ranges::sort(cell.unnoticed);
  return cell;
}

void print_tables(const Results& results) {
  fmt::print(
      "| fault | vehicle | flights | shown | stated s | median s | worst s | since it befell: median s | worst s | in "
      "time | ever | named rightly | "
      "flights with: closer than R_s to it | of these it could have been evaded | contact | others' violations | false "
      "alarms |\n");
  fmt::print(
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  Cell sum;
  for (std::size_t fault = 0; fault < kFaults; ++fault) {
    for (std::size_t vehicle = 0; vehicle < kVehicles.size(); ++vehicle) {
      const Cell cell = cell_of(results, vehicle, fault);
      const double stated = runtime::stated_time_s(runtime::trial_mission(mission_of(kVehicles[vehicle])),
                                                   static_cast<Misfortune>(fault));
      const bool any = !cell.delays.empty();
      fmt::print(
          "| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {} | {} | {} | {} | {} | {} | {} "
          "|\n",
          runtime::kMisfortuneWords[fault], kVehicles[vehicle], cell.trials, cell.shown, stated,
          any ? cell.delays[cell.delays.size() / 2] : 0.0, any ? cell.delays.back() : 0.0,
          any ? cell.unnoticed[cell.unnoticed.size() / 2] : 0.0, any ? cell.unnoticed.back() : 0.0, cell.in_time,
          cell.noticed, cell.named, cell.close, cell.evadable, cell.contact, cell.others, cell.false_alarms);
      sum.shown += cell.shown;
      sum.in_time += cell.in_time;
      sum.noticed += cell.noticed;
      sum.named += cell.named;
      sum.close += cell.close;
      sum.evadable += cell.evadable;
      sum.others += cell.others;
    }
  }
  const auto share = [&](std::size_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, sum.shown));
  };
  fmt::print("\nof {} faults that showed: {:.2f} % noticed in time, {:.2f} % ever, {:.2f} % named rightly\n\n",
             sum.shown, share(sum.in_time), share(sum.noticed), share(sum.named));
  fmt::print(
      "closer than R_s to the faulty drone: {:.0f} flights, in {:.0f} of which it could have been evaded; violations "
      "of "
      "others: {:.0f}\n\n",
      sum.close, sum.evadable, sum.others);
  for (std::size_t vehicle = 0; vehicle < kVehicles.size(); ++vehicle) {
    double hours = 0.0;
    double alarms = 0.0;
    for (const auto& [key, v] : results)
      if (v[0] == static_cast<double>(vehicle) && v[1] == static_cast<double>(kFaults)) {
        hours += kQuietFlightS / 3600.0;
        alarms += v[3];
      }
    fmt::print("- {}: {:.0f} false alarms in {:.0f} h without a fault\n", kVehicles[vehicle], alarms, hours);
  }
}

}  // namespace
}  // namespace vigil

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: fault_matrix RESULTS.csv [MOMENTS [HOURS]]\n");
    return 2;
  }
  const std::uint64_t moments = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100;
  const std::uint64_t hours = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 100;
  vigil::fly_all(vigil::all_jobs(moments, hours), argv[1]);
  vigil::print_tables(vigil::read_results(argv[1]));
  return 0;
}
