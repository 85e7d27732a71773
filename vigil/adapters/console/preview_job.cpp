#include "vigil/adapters/console/preview_job.hpp"

#include <exception>

#include "vigil/adapters/console/preview_json.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::console {
namespace {

DeskNews refusal(const PreviewJob& job, std::string_view code, std::string reason) {
  return DeskRefusal{job.ticket, code, std::move(reason)};
}

runtime::PreviewStart start_of(const PreviewJob& job, swarm::SwarmState state) {
  const runtime::Mission& mission = job.flight->mission();
  const runtime::PredictedVehicle vehicle = predicted_vehicle(mission, state.parameters().barrier.lag_s);
  return {std::move(state), job.areas, vehicle, runtime::footprint_radius_m(mission)};
}

DeskNews look_ahead(const PreviewJob& job, const std::atomic<bool>& cancelled) {
  const auto superseded = [&] { return refusal(job, "superseded", "a newer preview was asked for"); };
  if (cancelled.load(std::memory_order_relaxed)) return superseded();
  std::optional<swarm::SwarmState> state = job.flight->copy_state(cancelled);
  if (cancelled.load(std::memory_order_relaxed)) return superseded();
  if (!state || state->ticks() == 0)
    return refusal(job, "not_now", "the flight has not begun, or has ended; try again");
  const runtime::PreviewStart start = start_of(job, *std::move(state));
  const std::optional<runtime::Outlooks> outlooks = runtime::look_ahead(start, job.question, cancelled);
  if (!outlooks) return superseded();
  return PreviewNews{job.ticket, preview_json(*outlooks, {job.flight->epoch(), job.revision,
                                                          runtime::world_frame(job.flight->mission())})};
}

}  // namespace

DeskNews answer_of(const PreviewJob& job, const std::atomic<bool>& cancelled) {
  try {
    return look_ahead(job, cancelled);
  } catch (const std::exception& error) {
    return refusal(job, "not_now", error.what());
  }
}

std::optional<std::vector<runtime::AreaOutlook>> areas_ahead(const PreviewJob& job,
                                                             const std::atomic<bool>& cancelled) {
  try {
    std::optional<swarm::SwarmState> state = job.flight->copy_state(cancelled);
    if (!state || state->ticks() == 0) return std::nullopt;
    auto outlook = runtime::look_into_future(start_of(job, *std::move(state)), {}, job.question.seconds, cancelled);
    return outlook ? std::optional(std::move(outlook->areas)) : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;  // nobody asked: nothing is known of the time to come, as before
  }
}

}  // namespace vigil::console
