#include "vigil/adapters/console/why_answer.hpp"

#include <optional>
#include <string>

#include "vigil/runtime/velocity_reasons.hpp"

namespace vigil::console {

Json why_json(const swarm::SwarmState& state, swarm::DroneId drone, const runtime::Mission& mission,
              std::uint32_t epoch) {
  Json message{{"type", "why"}, {"id", 0}, {"epoch", epoch}};
  message.update(runtime::velocity_reasons_json(state, drone, mission));
  return message;
}

DeskNews answer_from(const swarm::SwarmState& state, const WhyQuestion& question, const runtime::ShownFlight& flight) {
  if (question.drone >= flight.mission().drones.size())
    return DeskRefusal{question.ticket, "not_now", "another mission was loaded meanwhile"};
  return PreviewNews{question.ticket,
                     why_json(state, swarm::DroneId(question.drone), flight.mission(), flight.epoch())};
}

DeskNews answer_of(const WhyQuestion& question, runtime::LiveMission& flight, const std::atomic<bool>& cancelled) {
  const std::optional<swarm::SwarmState> state = flight.copy_state(cancelled);
  if (cancelled.load(std::memory_order_relaxed))
    return DeskRefusal{question.ticket, "superseded", std::string(kNewerQuestion)};
  if (!state || state->ticks() == 0)
    return DeskRefusal{question.ticket, "not_now", "the flight has not begun, or has ended; try again"};
  return answer_from(*state, question, flight);
}

}  // namespace vigil::console
