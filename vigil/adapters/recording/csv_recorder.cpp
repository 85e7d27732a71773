#include "vigil/adapters/recording/csv_recorder.hpp"

#include <algorithm>
#include <cassert>
#include <exception>
#include <optional>
#include <utility>

#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/adapters/recording/vocabulary.hpp"
#include "vigil/runtime/least_clearances.hpp"
#include "vigil/swarm/names.hpp"

namespace vigil::recording {
namespace {

void cells(CsvFile& file, const Vec2& v) {
  file.cell(v.x());
  file.cell(v.y());
}

void cell(CsvFile& file, bool value) { file.cell(std::uint64_t{value ? 1U : 0U}); }

CsvFile with_header(const std::filesystem::path& path, std::string_view header) {
  CsvFile file(path);
  file.raw(header);
  file.raw("\n");
  file.flush();
  return file;
}

std::string_view truth_word(bool truth) { return truth ? "true" : "false"; }

}  // namespace

CsvRecorder::CsvRecorder(const std::filesystem::path& directory, std::string mission_text, std::uint64_t keep_every)
    : folder_(directory), mission_text_(std::move(mission_text)), keep_every_(keep_every) {
  assert(keep_every >= 1);
}

void CsvRecorder::begin(const runtime::Mission& mission, const runtime::FlightStart& /*start*/) {
  create_folder(folder_);
  frame_ = {mission.field.origin_m, mission.field.yaw_rad};
  for (const runtime::DroneEntry& drone : mission.drones) {
    ids_.push_back(drone.id);
    holders_.push_back(fmt::format("{}{}", kDronePrefix, drone.id));
  }
  write_text(folder_ / kMissionFile, mission_text_);
  ticks_ = with_header(folder_ / kTickFile, kTickHeader);
  drones_ = with_header(folder_ / kDroneFile, kDroneHeader);
  targets_ = with_header(folder_ / kTargetFile, kTargetHeader);
  events_ = with_header(folder_ / kEventFile, kEventHeader);
  skipped_.emplace(Skipped{swarm::Snapshot(ids_.size()), {}});
  skipped_->truth.reserve(ids_.size());
}

template <class Write>
void CsvRecorder::guarded(const Write& write) noexcept {
  if (!failure_.empty()) return;
  try {
    write();
  } catch (const std::exception& problem) {
    failure_ = problem.what();
  }
}

void CsvRecorder::record(const runtime::TickRecord& tick) noexcept {
  guarded([&] {
    least_ = least(least_, tick.clearances);
    fallback_ = fallback_ || tick.snapshot.fallback;
    last_time_s_ = tick.snapshot.time_s;
    if (seen_++ % keep_every_ == 0) {
      keep(tick.snapshot, tick.truth);
    } else {
      skip(tick);
    }
  });
}

void CsvRecorder::skip(const runtime::TickRecord& tick) {
  skipped_->snapshot = tick.snapshot;
  skipped_->truth.assign(tick.truth.begin(), tick.truth.end());
  has_skipped_ = true;
}

void CsvRecorder::keep(const swarm::Snapshot& snapshot, std::span<const runtime::TruthSample> truth) {
  write_tick(snapshot);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    write_drone(snapshot.time_s, i, snapshot.drones[i], truth.empty() ? nullptr : &truth[i]);
  }
  least_ = {};
  fallback_ = false;
  has_skipped_ = false;
}

void CsvRecorder::write_tick(const swarm::Snapshot& snapshot) {
  ticks_.cell(snapshot.time_s);
  if (snapshot.has_metric) {
    ticks_.cell(snapshot.metric);
    ticks_.cell(snapshot.metric_percent);
  } else {
    ticks_.empty_cell();
    ticks_.empty_cell();
  }
  ticks_.cell(std::uint64_t{snapshot.active});
  ticks_.cell(swarm::name_of(snapshot.idle));
  cell(ticks_, fallback_);
  ticks_.cell(least_.airborne_pair_m);
  ticks_.cell(least_.active_pair_m);
  ticks_.cell(least_.wall_m);
  ticks_.cell(least_.no_fly_m);
  ticks_.end_row();
}

void CsvRecorder::write_drone(double time_s, std::size_t drone, const swarm::DroneSnapshot& snapshot,
                              const runtime::TruthSample* truth) {
  drones_.cell(time_s);
  drones_.cell(ids_[drone]);
  drones_.cell(swarm::name_of(snapshot.mode));
  drones_.cell(swarm::name_of(snapshot.activity));
  cells(drones_, frame_.point_to_world(snapshot.position));
  drones_.cell(snapshot.height_m);
  cells(drones_, frame_.vector_to_world(snapshot.velocity));
  drones_.cell(snapshot.age_s);
  cells(drones_, frame_.vector_to_world(snapshot.u_nom));
  drones_.cell(swarm::name_of(snapshot.order.action));
  cells(drones_, frame_.vector_to_world(snapshot.order.velocity));
  write_holding(snapshot.filter);
  cell(drones_, snapshot.filter.fallback);
  write_truth(truth);
  drones_.end_row();
}

void CsvRecorder::write_holding(const safety::FilterReport& report) {
  const auto* const end = report.holding.data() + report.holding_count;
  const auto* const row = std::min_element(report.holding.data(), end,
                                           [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
  if (row == end) {
    drones_.empty_cell();
    drones_.empty_cell();
    return;
  }
  const auto index = static_cast<std::size_t>(row->index);
  switch (row->kind) {
    case safety::RowKind::kNeighbour:
      drones_.cell(std::string_view(holders_[index]));
      break;
    case safety::RowKind::kWall:
      drones_.plain_cell(kWallPrefix, kWallWords[index]);
      break;
    case safety::RowKind::kNoFly:
      drones_.plain_cell(kNoFlyPrefix, fmt::format_int(index).c_str());
      break;
  }
  drones_.cell(row->distance_m);
}

void CsvRecorder::write_truth(const runtime::TruthSample* truth) {
  if (truth == nullptr) {
    for (int i = 0; i < 3; ++i) drones_.empty_cell();
    return;
  }
  cells(drones_, frame_.point_to_world(truth->position));
  drones_.cell(truth->height_m);
}

void CsvRecorder::log(const runtime::LoggedEvent& event) noexcept {
  guarded([&] { write_event(event); });
}

void CsvRecorder::write_event(const runtime::LoggedEvent& event) {
  events_.cell(event.time_s);
  events_.cell(std::string_view(event.source));
  events_.cell(std::string_view(event.what));
  events_.cell(std::string_view(event.drone));
  events_.cell(std::string_view(event.detail));
  events_.end_row();
  events_.flush();
}

void CsvRecorder::targets(double time_s, const runtime::MissionTargets& targets) noexcept {
  guarded([&] { write_targets(time_s, targets); });
}

void CsvRecorder::write_targets(double time_s, const runtime::MissionTargets& targets) {
  const auto cell_or_none = [this](std::optional<double> value) {
    value ? targets_.cell(*value) : targets_.empty_cell();
  };
  const auto begin_row = [&](std::string_view kind, const std::string& name, std::optional<double> weight,
                             std::optional<double> revisit_s, std::optional<double> soft_edge_m,
                             std::string_view protect) {
    targets_.cell(time_s);
    targets_.cell(kind);
    targets_.cell(std::string_view(name));
    for (const std::optional<double> value : {weight, revisit_s, soft_edge_m}) cell_or_none(value);
    protect.empty() ? targets_.empty_cell() : targets_.cell(protect);
  };
  const auto end_row = [&](const Vec2& point) {
    cells(targets_, point);
    targets_.end_row();
  };
  const auto& [wanted, no_fly] = targets;
  for (const runtime::ClusterEntry& cluster : wanted.clusters) {
    for (const Vec2& point : cluster.points_m) {
      begin_row("cluster", cluster.name, cluster.weight, cluster.revisit_s, {}, truth_word(cluster.is_protected));
      end_row(point);
    }
  }
  for (const runtime::AreaEntry& area : wanted.areas) {
    for (const Vec2& corner : area.outline_m) {
      begin_row("area", area.name, area.weight, area.revisit_s, area.soft_edge_m, truth_word(area.is_protected));
      end_row(corner);
    }
  }
  for (const runtime::NoFlyEntry& polygon : no_fly) {
    for (const Vec2& corner : polygon.outline_m) {
      begin_row("no_fly", polygon.name, {}, {}, {}, "");
      end_row(corner);
    }
  }
  // The floor ends every list, so that one without any target is a list too.
  begin_row("floor", "", wanted.uniform_floor, {}, {}, "");
  for (int i = 0; i < 2; ++i) targets_.empty_cell();
  targets_.end_row();
  targets_.flush();
}

void CsvRecorder::finish() {
  guarded([&] {
    if (has_skipped_) keep(skipped_->snapshot, skipped_->truth);
  });
  for (CsvFile* file : {&ticks_, &drones_, &targets_}) close(*file);
  // The line that says "finished" is written last, and only where all the rest was kept.
  guarded([&] {
    write_event({last_time_s_, std::string(kRecorderSource), std::string(kFinished), "",
                 fmt::format("{} ticks, {} rows of drones", ticks_.rows(), drones_.rows())});
  });
  close(events_);
  if (!failure_.empty()) throw RecordingError(fmt::format("{}; the recording is not complete", failure_));
}

void CsvRecorder::close(CsvFile& file) noexcept {
  guarded([&] {
    if (!file.close()) failure_ = file.error();
  });
}

}  // namespace vigil::recording
