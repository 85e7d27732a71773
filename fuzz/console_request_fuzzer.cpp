// The way of commands from a socket's bytes to the swarm: an HTTP request through parser, REST, hub, desk and control
// loop; and lines of text as a WebSocket's messages. Whatever comes is answered once, leaves a mission that keeps the
// rules, and from a viewer changes nothing.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/adapters/console/http_wire.hpp"

namespace {

using namespace vigil;
using namespace std::chrono_literals;
using console::ConsoleForTests;
using console::Json;

constexpr std::size_t kMostLines = 40;
constexpr std::size_t kMostDrones = 50;

void require(bool holds) {
  if (!holds) std::abort();
}

void require_sound(const ConsoleForTests& console) {
  require(!runtime::check_targets(*console.hub.mission()));
  for (const swarm::DroneSnapshot& drone : console.newest().snapshot.drones)
    require(drone.position.allFinite() && drone.order.velocity.allFinite());
}

void require_untouched(const ConsoleForTests& console) {
  const Json state = console.hub.state();
  require(state.at("epoch") == 1 && state.at("revision") == 1 && state.at("active") == 3);
  require(state.at("speed") == 1.0 && state.at("is_paused") == false);
}

template <typename Body>
bool is_message(std::string_view text) {
  const auto parsed = console::parse_client_message(text);
  const auto* message = std::get_if<console::ClientMessage>(&parsed);
  return message != nullptr && std::holds_alternative<Body>(message->body);
}

/// A thread of its own answers that, after a moment.
bool asks_why(std::string_view text) { return is_message<console::Why>(text); }

/// A thread of its own answers that, after as long as it takes.
bool looks_ahead(std::string_view text) { return is_message<console::Preview>(text); }

/// All of a request, as Boost.Beast reads it off a socket; false where it is none, or more should come.
bool parse(std::string_view bytes, console::WireParser& parser) {
  console::bound(parser);
  parser.eager(true);
  boost::system::error_code error;
  while (!bytes.empty() && !parser.is_done() && !error) {
    const std::size_t used = parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    if (used == 0) break;
    bytes.remove_prefix(used);
  }
  return parser.is_done() && !error;
}

void require_answer(const console::HttpAnswer& answer, const console::WireRequest& request) {
  require(answer.status >= 200 && answer.status < 600 && answer.body != nullptr);
  if (answer.content_type == "application/json") require(Json::accept(*answer.body));
  require(console::wire_response(answer, request).result_int() == static_cast<unsigned>(answer.status));
}

void as_request(std::string_view bytes) {
  console::WireParser parser;
  if (!parse(bytes, parser)) return;
  console::WireRequest wire = parser.release();
  static const console::Gate kGate("127.0.0.1", {});
  static const console::Page kPage("there is no such folder");
  if (const auto refusal = console::upgrade_refusal(wire, kGate)) require_answer(*refusal, wire);
  ConsoleForTests console;
  console.most_drones = kMostDrones;
  console.fly();
  console::Rest rest(console.hub, kGate, kPage);
  const console::HttpRequest request = console::http_request(wire);
  if (looks_ahead(request.body) || request.target.starts_with("/api/preview")) return;
  int answers = 0;
  rest.answer(request, [&](const console::HttpAnswer& answer) {
    require_answer(answer, wire);
    ++answers;
  });
  if (asks_why(request.body) || request.target.starts_with("/api/why")) console.pass_until([&] { return answers > 0; });
  console.pass(200ms);
  require(answers == 1);
  require_sound(console);
  if (request.method != "POST" || !kGate.admits_host(request.host)) require_untouched(console);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty() && lines.size() < kMostLines) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::size_t answers_in(const console::RecordedLine& told) {
  std::size_t answers = 0;
  for (const char* type : {"ack", "refused", "pong", "why"}) answers += told.of(type).size();
  return answers;
}

/// Every line is answered, once; but for a second hello, which changes who one is.
void as_messages(const std::vector<std::string_view>& lines, const char* role) {
  ConsoleForTests console;
  console.most_drones = kMostDrones;
  console.fly();
  const ConsoleForTests::Visitor visitor = console.join({{"role", role}});
  std::size_t asked = 0;
  for (const std::string_view line : lines) {
    if (is_message<console::Hello>(line) || looks_ahead(line)) continue;
    console.hub.receive(visitor.id, line);
    console.pass(25ms);
    ++asked;
    if (asks_why(line)) console.pass_until([&] { return answers_in(*visitor.line) >= asked; });
  }
  console.pass(200ms);
  const console::RecordedLine& told = *visitor.line;
  require(answers_in(told) == asked);
  require(!told.is_closed);
  require_sound(console);
  if (std::string_view(role) == "viewer") require_untouched(console);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  as_request(bytes);
  if (bytes.find('{') == std::string_view::npos || bytes.starts_with("GET ") || bytes.starts_with("POST ")) return 0;
  const std::vector<std::string_view> lines = lines_of(bytes);
  as_messages(lines, "safety_pilot");
  as_messages(lines, "viewer");
  return 0;
}
