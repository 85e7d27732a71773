#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include <boost/beast/http.hpp>

#include "vigil/adapters/console/access.hpp"
#include "vigil/adapters/console/rest.hpp"

/// Between HTTP as Boost.Beast reads and writes it, and what answers depend on. No sockets.
namespace vigil::console {

using WireRequest = boost::beast::http::request<boost::beast::http::string_body>;
using WireResponse = boost::beast::http::response<boost::beast::http::string_body>;
using WireParser = boost::beast::http::request_parser<boost::beast::http::string_body>;

inline constexpr std::uint32_t kMostHeaderBytes = 16 * 1024;
/// The WebSocket subprotocol that this server speaks.
inline constexpr std::string_view kProtocol = "vigil.v1";

/// Lets a parser read so much of a request and no more.
void bound(WireParser& parser);

/// Takes the body out of `request`; the rest stays.
[[nodiscard]] HttpRequest http_request(WireRequest& request);

/// Why a request is not looked at; nothing where it is.
[[nodiscard]] std::optional<HttpAnswer> request_refusal(const WireRequest& request);

/// Why a request for a WebSocket is not granted; nothing where it is. Precondition: it is one.
[[nodiscard]] std::optional<HttpAnswer> upgrade_refusal(const WireRequest& request, const Gate& gate);

[[nodiscard]] WireResponse wire_response(const HttpAnswer& answer, const WireRequest& request);

}  // namespace vigil::console
