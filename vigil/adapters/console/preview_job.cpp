#include "vigil/adapters/console/preview_job.hpp"

#include <exception>

#include "vigil/adapters/console/preview_json.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::console {
namespace {

DeskNews refusal(const PreviewJob& job, std::string_view code, std::string reason) {
  return DeskRefusal{job.ticket, code, std::move(reason)};
}

DeskNews look_ahead(const PreviewJob& job, const std::atomic<bool>& cancelled) {
  const auto superseded = [&] { return refusal(job, "superseded", "a newer preview was asked for"); };
  if (cancelled.load(std::memory_order_relaxed)) return superseded();
  std::optional<swarm::SwarmState> state = job.flight->copy_state(cancelled);
  if (cancelled.load(std::memory_order_relaxed)) return superseded();
  if (!state || state->ticks() == 0)
    return refusal(job, "not_now", "the flight has not begun, or has ended; try again");
  const runtime::Mission& mission = job.flight->mission();
  const runtime::PredictedVehicle vehicle = predicted_vehicle(mission, state->parameters().barrier.lag_s);
  const runtime::PreviewStart start{*std::move(state), job.areas, vehicle, runtime::footprint_radius_m(mission)};
  const std::optional<runtime::Outlooks> outlooks = runtime::look_ahead(start, job.question, cancelled);
  if (!outlooks) return superseded();
  return PreviewNews{job.ticket,
                     preview_json(*outlooks, {job.flight->epoch(), job.revision, runtime::world_frame(mission)})};
}

}  // namespace

DeskNews answer_of(const PreviewJob& job, const std::atomic<bool>& cancelled) {
  try {
    return look_ahead(job, cancelled);
  } catch (const std::exception& error) {
    return refusal(job, "not_now", error.what());
  }
}

}  // namespace vigil::console
