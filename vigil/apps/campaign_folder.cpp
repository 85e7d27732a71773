#include "vigil/apps/campaign_folder.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include "vigil/apps/failure.hpp"
#include "vigil/apps/text_file.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

/// A plan is a mission in other words.
constexpr std::uintmax_t kMostPlanBytes = std::uintmax_t{16} << 20U;

[[noreturn]] void refuse(const fs::path& path, const std::string& problem) {
  throw Failure(kBadInput, fmt::format("--out {}: {}", path.string(), problem));
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw Failure(kComponentFailed, fmt::format("{}: {} ({})", path.string(), what, std::strerror(errno)));
}

/// Writes the plan into a new or empty directory; in any other, the plan must be there already, and the same.
void settle_plan(const fs::path& path, const std::string& plan) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) refuse(path, fmt::format("cannot be created ({}); name a place where you may write", error.message()));
  if (fs::is_regular_file(path / "plan.json")) {
    if (read_whole(path / "plan.json", kMostPlanBytes) == plan) return;
    refuse(path,
           "holds a campaign with another plan (see plan.json there); repeat its arguments, or name another directory");
  }
  if (!fs::is_empty(path, error) || error) refuse(path, "is there already and holds no campaign; name a new directory");
  write_whole(path / "plan.json", plan);
}

}  // namespace

CampaignFolder::CampaignFolder(fs::path path, const runtime::CampaignPlan& plan, const Take& take)
    : path_(std::move(path)), is_flown_(plan.runs, false) {
  settle_plan(path_, runtime::plan_json(plan));
  write_whole(path_ / "mission.yaml", plan.mission_yaml);
  open_runs();
  try {
    read_runs(take);
  } catch (...) {
    close(runs_file_);
    throw;
  }
}

CampaignFolder::~CampaignFolder() { close(runs_file_); }

void CampaignFolder::open_runs() {
  const fs::path file = path_ / "runs.jsonl";
  runs_file_ = open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (runs_file_ < 0) fail(file, "cannot be written");
  if (flock(runs_file_, LOCK_EX | LOCK_NB) == 0) return;
  close(runs_file_);
  refuse(path_, "is in use by another campaign; wait for its end");
}

void CampaignFolder::read_runs(const Take& take) {
  const fs::path path = path_ / "runs.jsonl";
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t whole_bytes = 0;
  std::uint64_t number = 0;
  for (std::string line; std::getline(file, line) && !file.eof(); whole_bytes += line.size() + 1) {
    ++number;
    const std::optional<runtime::RunRecord> record = runtime::parse_record(line);
    if (!record || record->number >= is_flown_.size())
      throw Failure(kComponentFailed,
                    fmt::format("{}:{}: is no run of this campaign; remove the line", path.string(), number));
    if (is_flown_[record->number]) continue;
    is_flown_[record->number] = true;
    take(*record);
  }
  // What follows the last end of a line was not written whole.
  if (ftruncate(runs_file_, static_cast<off_t>(whole_bytes)) != 0) fail(path, "cannot be cut to its whole lines");
}

std::vector<std::uint64_t> CampaignFolder::missing() const {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t run = 0; run < is_flown_.size(); ++run)
    if (!is_flown_[run]) missing.push_back(run);
  return missing;
}

void CampaignFolder::append(const std::string& line) {
  const std::string whole = line + "\n";
  for (std::size_t written = 0; written < whole.size();) {
    const ssize_t count = write(runs_file_, whole.data() + written, whole.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(path_ / "runs.jsonl", "cannot be written; make room and repeat the command");
    written += static_cast<std::size_t>(count);
  }
}

void CampaignFolder::write_summary(const std::string& json) const { write_whole(path_ / "summary.json", json); }

}  // namespace vigil::apps
