#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vigil/runtime/campaign_plan.hpp"
#include "vigil/runtime/campaign_record.hpp"

namespace vigil::apps {

/// The directory of a campaign: plan.json (written first), mission.yaml, runs.jsonl (a line a run, in the order in
/// which they ended) and, from time to time, summary.json. Whatever moment the program is killed at, the directory can
/// be continued: a line that was not written whole is dropped. One process at a time.
class CampaignFolder {
 public:
  using Take = std::function<void(const runtime::RunRecord&)>;

  /// Creates the directory, or continues the campaign that is there, whose finished runs it shows to `take` one by one.
  /// Throws Failure: kBadInput where the directory holds another plan or something else, or is in use; kComponentFailed
  /// where it cannot be read or written.
  CampaignFolder(std::filesystem::path path, const runtime::CampaignPlan& plan, const Take& take);
  CampaignFolder(const CampaignFolder&) = delete;
  CampaignFolder& operator=(const CampaignFolder&) = delete;
  ~CampaignFolder();

  /// The runs that are still to be flown, ascending.
  [[nodiscard]] std::vector<std::uint64_t> missing() const;

  /// Keeps the line of a finished run: it is with the operating system when this returns.
  void append(const std::string& line);
  void write_summary(const std::string& json) const;

 private:
  void open_runs();
  void read_runs(const Take& take);

  std::filesystem::path path_;
  std::vector<bool> is_flown_;
  int runs_file_ = -1;
};

}  // namespace vigil::apps
