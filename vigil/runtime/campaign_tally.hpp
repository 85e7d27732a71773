#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "vigil/runtime/campaign_record.hpp"

namespace vigil::runtime {

/// What a campaign came to, run by run; the order of the runs does not matter. About a hundred bytes a run.
class CampaignTally {
 public:
  CampaignTally();

  void add(const RunRecord& record);

  [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }
  /// Runs that broke any rule, by ground truth.
  [[nodiscard]] std::uint64_t violating_runs() const noexcept { return violators_.size(); }

  /// summary.json of a campaign, its counts and figures; docs/campaign.md says what each is.
  [[nodiscard]] nlohmann::ordered_json to_json() const;
  /// The same as a table for people.
  [[nodiscard]] std::string table() const;
  /// The worst so far, in a few words.
  [[nodiscard]] std::string worst_so_far() const;

 private:
  struct Worst {
    double value = 0.0;
    std::uint64_t run = 0;
    std::string command;
  };
  /// One figure of every run that has it.
  struct Column {
    std::vector<double> values;
    std::optional<Worst> worst;
  };

  void add_figure(std::size_t figure, double value, const RunRecord& record);
  void add_violations(const RunRecord& record);

  std::uint64_t runs_ = 0;
  std::vector<Column> columns_;           ///< in the order of the figures
  std::vector<std::uint64_t> broken_;     ///< runs that broke each rule
  std::vector<std::uint64_t> violators_;  ///< runs that broke any
};

}  // namespace vigil::runtime
