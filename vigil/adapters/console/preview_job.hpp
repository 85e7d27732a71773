#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vigil/adapters/console/desk.hpp"
#include "vigil/runtime/what_if.hpp"

namespace vigil::console {

/// A look ahead that somebody asked for, with all of the desk's that it needs.
struct PreviewJob {
  std::uint64_t ticket = 0;
  std::shared_ptr<runtime::LiveMission> flight;
  runtime::AreaWatch areas;    ///< what has been seen until now
  std::uint64_t revision = 0;  ///< of the present targets
  runtime::WhatIf question;
};

/// Does it: waits for the flight's state, at most a second, and runs it ahead. PreviewNews, or why there is none.
/// Any thread but the flight's own.
[[nodiscard]] DeskNews answer_of(const PreviewJob& job, const std::atomic<bool>& cancelled);

/// How every cluster and area will fare as things are; none where it was cancelled or the flight is over. As above.
[[nodiscard]] std::optional<std::vector<runtime::AreaOutlook>> areas_ahead(const PreviewJob& job,
                                                                           const std::atomic<bool>& cancelled);

}  // namespace vigil::console
