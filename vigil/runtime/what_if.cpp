#include "vigil/runtime/what_if.hpp"

#include <algorithm>
#include <utility>

#include "vigil/runtime/controller_setup.hpp"
#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::runtime {
namespace {

std::optional<Outlook> changed_future(PreviewStart start, const WhatIf& question, const std::atomic<bool>& cancelled) {
  PreviewChange change{nullptr, question.without};
  if (question.targets) {
    const ergodic::Basis& basis = start.state.basis();
    change.target = previewed_target(*question.targets, basis);
    const double now_s = static_cast<double>(start.state.ticks()) * start.state.parameters().dt_s;
    start.areas.retarget(*question.targets, basis, *change.target, now_s);
  }
  return look_into_future(std::move(start), change, question.seconds, cancelled);
}

}  // namespace

std::shared_ptr<const swarm::CoverageTarget> previewed_target(const Mission& mission, const ergodic::Basis& basis) {
  constexpr Eigen::Index kCells = 128;  // along the longer side, and ...
  constexpr Eigen::Index kCellsAHalfWave = 8;
  const Eigen::Index cells = std::max<Eigen::Index>(kCells, kCellsAHalfWave * basis.max_index());
  return coverage_target(mission, basis, grid_of(basis.field(), cells));
}

std::optional<Outlooks> look_ahead(const PreviewStart& start, const WhatIf& question,
                                   const std::atomic<bool>& cancelled) {
  Outlooks outlooks;
  outlooks.tick = start.state.ticks();
  outlooks.time_s = static_cast<double>(outlooks.tick) * start.state.parameters().dt_s;
  std::optional<Outlook> as_is = look_into_future(start, {}, question.seconds, cancelled);
  if (!as_is) return std::nullopt;
  outlooks.as_is = *std::move(as_is);
  if (!question.changes_anything()) return outlooks;
  outlooks.what_if = changed_future(start, question, cancelled);
  if (!outlooks.what_if) return std::nullopt;
  return outlooks;
}

}  // namespace vigil::runtime
