// What a client of the console may send, and what it makes of a mission: any bytes are refused with a reason or obeyed,
// and whatever was obeyed keeps the rules of mission files. The same bytes are an import of areas, and an HTTP
// request's host and origin.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "vigil/adapters/console/access.hpp"
#include "vigil/adapters/console/areas_geojson.hpp"
#include "vigil/adapters/console/client_message.hpp"
#include "vigil/runtime/mission_desk.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace {

using namespace vigil;

constexpr const char* kMission = R"(format: 1
name: fuzz
field: {size_m: [4, 2]}
targets:
  clusters: [{name: east, points_m: [[3, 1], [3.5, 1.5]]}]
  areas: [{name: west, outline_m: [[0.5, 0.5], [1, 0.5], [1, 1]]}]
no_fly: [{name: mast, outline_m: [[2, 0.25], [2.25, 0.25], [2, 0.5]]}]
drones: [{id: a, start_m: [0.5, 1.5]}]
control: {speed_limit_m_s: 0.5}
safety: {separation_m: 0.25, wall_distance_m: 0.125}
)";

void require(bool holds) {
  if (!holds) std::abort();
}

void change(const std::vector<runtime::TargetEdit>& edits) {
  static const runtime::Mission kBefore = runtime::parse_mission(kMission, "fuzz");
  runtime::MissionDesk desk(kBefore);
  const auto refusal = desk.edit(edits, 1, "fuzz");
  if (refusal) {
    require(!refusal->reason.empty() && desk.mission() == kBefore);
    return;
  }
  require(!runtime::check_targets(desk.mission()));
  require(!desk.undo(desk.revision(), "fuzz") && desk.mission() == kBefore);
}

void say(std::string_view text) {
  const auto parsed = console::parse_client_message(text);
  if (const auto* refusal = std::get_if<console::MessageRefusal>(&parsed)) {
    require(!refusal->code.empty() && !refusal->reason.empty());
    return;
  }
  const auto& message = std::get<console::ClientMessage>(parsed);
  const bool has_no_id =
      std::holds_alternative<console::Hello>(message.body) || std::holds_alternative<console::Confirm>(message.body);
  require(message.id.has_value() != has_no_id);
  if (const auto* edit = std::get_if<console::Edit>(&message.body)) change(edit->edits);
}

void import(std::string_view text) {
  static const runtime::Mission kBefore = runtime::parse_mission(kMission, "fuzz");
  const auto edits = console::edits_of_geojson(text, kBefore);
  if (const auto* changes = std::get_if<std::vector<runtime::TargetEdit>>(&edits)) change(*changes);
}

void knock(std::string_view text) {
  static const console::Gate kGate("127.0.0.1", {});
  const std::size_t middle = text.size() / 2;
  const std::string_view host = text.substr(0, middle);
  if (kGate.admits_origin(text.substr(middle), host) && middle < text.size()) require(kGate.admits_host(host));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  say(text);
  import(text);
  knock(text);
  return 0;
}
