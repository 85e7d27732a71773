#include "vigil/adapters/console/http_wire.hpp"

#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace vigil::console {
namespace {

namespace http = boost::beast::http;

std::string header(const WireRequest& request, http::field field) {
  const auto found = request.find(field);
  return found == request.end() ? std::string() : std::string(found->value());
}

bool offers_protocol(const WireRequest& request) {
  for (const auto& offered : http::token_list(request[http::field::sec_websocket_protocol]))
    if (std::string_view(offered.data(), offered.size()) == kProtocol) return true;
  return false;
}

HttpAnswer in_words(int status, std::string text) {
  return {status, "text/plain; charset=utf-8", std::make_shared<const std::string>(std::move(text) + "\n"), {}};
}

}  // namespace

void bound(WireParser& parser) {
  parser.header_limit(kMostHeaderBytes);
  parser.body_limit(kMostMessageBytes);
}

HttpRequest http_request(WireRequest& request) {
  return {std::string(request.method_string()),
          std::string(request.target()),
          header(request, http::field::host),
          header(request, http::field::origin),
          header(request, http::field::authorization),
          header(request, http::field::content_type),
          header(request, http::field::accept),
          header(request, http::field::if_none_match),
          std::move(request.body())};
}

std::optional<HttpAnswer> request_refusal(const WireRequest& request) {
  // What stands before this server may have looked at the other one (RFC 9112, 3.2).
  if (request.count(http::field::host) > 1) return in_words(400, "a request has one Host header");
  return std::nullopt;
}

std::optional<HttpAnswer> upgrade_refusal(const WireRequest& request, const Gate& gate) {
  const std::string host = header(request, http::field::host);
  if (!gate.admits_host(host)) return in_words(421, "this name is not one of the server's");
  if (!gate.admits_origin(header(request, http::field::origin), host))
    return in_words(403, "another site's page may not come in");
  if (request.target() != "/live") return in_words(404, "the WebSocket is at /live");
  if (!offers_protocol(request)) return in_words(400, fmt::format("this server speaks {}", kProtocol));
  return std::nullopt;
}

WireResponse wire_response(const HttpAnswer& answer, const WireRequest& request) {
  WireResponse response(static_cast<http::status>(answer.status), request.version());
  response.set(http::field::server, "vigil");
  response.set(http::field::content_type, answer.content_type);
  for (const auto& [name, value] : security_headers()) response.set(name, value);
  for (const auto& [name, value] : answer.headers) response.set(name, value);
  response.keep_alive(request.keep_alive());
  if (answer.body) response.body() = *answer.body;
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

}  // namespace vigil::console
