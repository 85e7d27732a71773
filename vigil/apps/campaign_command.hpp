#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vigil::apps {

struct CampaignOptions {
  std::filesystem::path mission;
  std::filesystem::path out;  ///< new, or with the same campaign to go on with
  std::uint64_t runs = 0;
  std::uint64_t seed = 1;
  std::optional<std::string> seconds;  ///< instead of the mission's simulation.duration_s
  std::vector<std::string> settings;   ///< key=value
  std::vector<std::string> vary;       ///< campaign_variation.hpp
  unsigned threads = 0;                ///< 0: one a core
  bool json = false;                   ///< the summary to standard output
  bool mpi = false;                    ///< share the runs with the other processes that mpirun started
};

/// `vigil campaign`: flies the mission many times, each time a little different, and leaves plan.json, runs.jsonl and
/// summary.json in options.out. Returns the exit code: 1 where a run broke a rule. Throws what main() turns into one
/// line and an exit code.
[[nodiscard]] int campaign(const CampaignOptions& options);

}  // namespace vigil::apps
