#include "vigil/adapters/console/rest.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "vigil/adapters/console/areas_geojson.hpp"
#include "vigil/adapters/console/mission_json.hpp"
#include "vigil/adapters/console/query.hpp"
#include "vigil/runtime/mission_writer.hpp"

namespace vigil::console {
namespace {

constexpr std::string_view kRestName = "REST";

SharedBytes shared(std::string bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

HttpAnswer json_answer(int status, const Json& json) {
  return {status, "application/json", shared(in_text(json) + "\n"), {{"Cache-Control", "no-store"}}};
}

HttpAnswer refusal(int status, std::string_view code, std::string_view reason) {
  return json_answer(status, {{"type", "refused"}, {"id", nullptr}, {"code", code}, {"reason", reason}});
}

/// The status that says the same as the protocol's answer.
int status_of(const Json& answer) {
  if (answer.at("type") != "refused") return 200;
  const std::string code = answer.at("code");
  if (code == "not_allowed") return 403;
  if (code == "busy" || code == "too_fast") return 429;
  if (code == "stale" || code == "not_now" || code == "superseded") return 409;
  if (code == "unknown_drone") return 404;
  return code == "too_large" ? 413 : 400;
}

bool is_json(const std::string& content_type) {
  const std::string type = lower(content_type.substr(0, content_type.find(';')));
  return type == "application/json" || type == "application/geo+json";
}

std::string bearer_of(const std::string& authorization) {
  constexpr std::string_view kScheme = "bearer ";  // in any case (RFC 9110, 11.1)
  if (lower(std::string_view(authorization).substr(0, kScheme.size())) != kScheme) return {};
  return authorization.substr(kScheme.size());
}

HttpAnswer not_found() {
  return refusal(404, "not_found", "there is nothing at this address; see protocol/openapi.json");
}

HttpAnswer nothing_flies() { return refusal(503, "not_now", "nothing is flown yet; try again"); }

struct Path {
  std::string_view name;
  std::string_view methods;
  std::string_view query;  ///< the one name that a query may have; empty: none
};

constexpr std::array<Path, 6> kPaths{{{"/api/state", "GET", ""},
                                      {"/api/mission", "GET", "format"},
                                      {"/api/areas", "GET, POST", ""},
                                      {"/api/commands", "POST", ""},
                                      {"/api/preview", "POST", ""},
                                      {"/api/why", "GET", "drone"}}};

HttpAnswer wrong_method(std::string_view methods) {
  HttpAnswer answer = refusal(405, "wrong_method", fmt::format("this path answers to {}", methods));
  answer.headers.emplace_back("Allow", methods);
  return answer;
}

constexpr std::string_view kNotBuilt =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>vigil</title><body><h1>vigil is "
    "running</h1><p>The "
    "console's page was not built. Start vigil by <code>./run</code>, which builds it, or ask <a "
    "href=\"/api/state\">/api/state</a>.</p></body></html>\n";

}  // namespace

HttpAnswer too_large() {
  return refusal(413, "too_large", fmt::format("a request has at most {} bytes", kMostMessageBytes));
}

const std::vector<std::pair<std::string, std::string>>& security_headers() {
  static const std::vector<std::pair<std::string, std::string>> kHeaders{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src "
       "'self'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
       "frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
  return kHeaders;
}

void Rest::answer(const HttpRequest& request, const Reply& reply) {
  if (!gate_.admits_host(request.host))
    return reply(refusal(421, "wrong_host", "this name is not one of the server's; see --name"));
  const std::size_t question = request.target.find('?');
  const std::string path = request.target.substr(0, question);
  const std::string query = question == std::string::npos ? "" : request.target.substr(question + 1);
  if (path.starts_with("/api/")) return answer_api(request, path, query, reply);
  if (request.method != "GET" && request.method != "HEAD") return reply(wrong_method("GET, HEAD"));
  reply(page_file(request, path));
}

void Rest::answer_api(const HttpRequest& request, const std::string& path, const std::string& query,
                      const Reply& reply) {
  if (path == "/api/version")
    return reply(json_answer(
        200, {{"program", hub_.program()}, {"protocols", Json::array({"vigil.v1"})}, {"login", hub_.wants_login()}}));
  const auto role = hub_.role_for(bearer_of(request.authorization));
  if (!role) {
    HttpAnswer answer = refusal(401, "bad_token", "send the header Authorization: Bearer TOKEN");
    answer.headers.emplace_back("WWW-Authenticate", "Bearer");
    return reply(std::move(answer));
  }
  if (request.body.size() > kMostMessageBytes) return reply(too_large());
  const auto known = std::ranges::find(kPaths, path, &Path::name);
  if (known == kPaths.end()) return reply(not_found());
  if (const std::string problem = query_problem(query, known->query); !problem.empty())
    return reply(refusal(400, "malformed", problem));
  const bool is_get = request.method == "GET";
  const bool is_post = request.method == "POST";
  const auto has = [&](std::string_view method) { return known->methods.find(method) != std::string_view::npos; };
  if (!(is_get && has("GET")) && !(is_post && has("POST"))) return reply(wrong_method(known->methods));
  if (is_post && !gate_.admits_origin(request.origin, request.host))
    return reply(refusal(403, "wrong_origin", "another site's page may not command drones"));
  if (is_post && !is_json(request.content_type))
    return reply(refusal(415, "wrong_type", "send the header Content-Type: application/json"));
  if (path == "/api/state") {
    const Json state = hub_.state();
    return reply(state.is_null() ? nothing_flies() : json_answer(200, state));
  }
  if (path == "/api/mission") return reply(mission(request, query));
  if (path == "/api/areas" && is_get) return reply(areas());
  if (path == "/api/areas") return import_areas(request, *role, reply);
  if (path == "/api/commands") return answer_command(parse_client_message(request.body), *role, reply);
  if (path == "/api/preview") return answer_command(parse_preview(request.body), *role, reply);
  explain(query, *role, reply);
}

HttpAnswer Rest::areas() const {
  if (hub_.mission() == nullptr) return nothing_flies();
  HttpAnswer answer = json_answer(200, areas_geojson(*hub_.mission()));
  answer.content_type = "application/geo+json";
  return answer;
}

HttpAnswer Rest::mission(const HttpRequest& request, const std::string& query) const {
  const runtime::Mission* mission = hub_.mission();
  if (mission == nullptr) return nothing_flies();
  const std::optional<std::string> format = query_value(query, "format");
  if (format && format != "yaml") return refusal(400, "malformed", "format: must be yaml; leave it out for JSON");
  const bool wants_yaml = format || request.accept.find("yaml") != std::string::npos;
  if (!wants_yaml) return json_answer(200, mission_json(*mission));
  return {200, "application/yaml", shared(runtime::mission_yaml(*mission)), {{"Cache-Control", "no-store"}}};
}

void Rest::answer_command(const std::variant<ClientMessage, MessageRefusal>& parsed, Role role, const Reply& reply) {
  if (const auto* refused = std::get_if<MessageRefusal>(&parsed)) {
    const Json json = refused_json(*refused);
    return reply(json_answer(status_of(json), json));
  }
  const auto& message = std::get<ClientMessage>(parsed);
  if (!message.id) return reply(refusal(400, "malformed", "hello and confirm are for WebSockets"));
  hub_.command(message, role, std::string(kRestName),
               [reply](const Json& json) { reply(json_answer(status_of(json), json)); });
}

void Rest::explain(const std::string& query, Role role, const Reply& reply) {
  if (!hub_.has_ticked()) return reply(nothing_flies());
  const std::optional<std::string> drone = query_value(query, "drone");
  if (!drone) return reply(refusal(400, "malformed", "say of which drone: /api/why?drone=ID"));
  answer_command(ClientMessage{0, "why", Why{*drone}}, role, reply);
}

void Rest::import_areas(const HttpRequest& request, Role role, const Reply& reply) {
  if (hub_.mission() == nullptr) return reply(nothing_flies());
  std::variant<std::vector<runtime::TargetEdit>, std::string> edits = edits_of_geojson(request.body, *hub_.mission());
  if (const auto* problem = std::get_if<std::string>(&edits)) return reply(refusal(400, "invalid", *problem));
  const ClientMessage message{0, "edit",
                              Edit{hub_.revision(), std::move(std::get<std::vector<runtime::TargetEdit>>(edits)), {}}};
  hub_.command(message, role, std::string(kRestName),
               [reply](const Json& json) { reply(json_answer(status_of(json), json)); });
}

HttpAnswer Rest::page_file(const HttpRequest& request, const std::string& path) const {
  if (path == "/" && !page_.is_built()) return {200, "text/html; charset=utf-8", shared(std::string(kNotBuilt)), {}};
  const PageFile* file = page_.find(path);
  if (file == nullptr) return not_found();
  const std::string caching = file->never_changes ? "public, max-age=31536000, immutable" : "no-cache";
  if (request.if_none_match == file->tag)
    return {304, file->content_type, shared(""), {{"ETag", file->tag}, {"Cache-Control", caching}}};
  return {200, file->content_type, file->bytes, {{"ETag", file->tag}, {"Cache-Control", caching}}};
}

}  // namespace vigil::console
