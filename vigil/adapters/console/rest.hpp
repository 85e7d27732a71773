#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "vigil/adapters/console/access.hpp"
#include "vigil/adapters/console/hub.hpp"
#include "vigil/adapters/console/page.hpp"

namespace vigil::console {

/// An HTTP request, as far as answers depend on it. Header values are as they came.
struct HttpRequest {
  std::string method;
  std::string target;  ///< path and query
  std::string host;
  std::string origin;
  std::string authorization;
  std::string content_type;
  std::string accept;
  std::string if_none_match;
  std::string body;
};

struct HttpAnswer {
  int status = 200;
  std::string content_type = "application/json";
  std::shared_ptr<const std::string> body;
  std::vector<std::pair<std::string, std::string>> headers;  ///< beside content type, length and what all answers have
};

/// What the server says by plain HTTP: the console's page, and the interface of protocol/openapi.json. The hub's
/// thread.
class Rest {
 public:
  using Reply = std::function<void(HttpAnswer)>;

  /// All outlive this.
  Rest(Hub& hub, const Gate& gate, const Page& page) : hub_(hub), gate_(gate), page_(page) {}

  /// Calls `reply` once, now or later.
  void answer(const HttpRequest& request, const Reply& reply);

 private:
  void answer_api(const HttpRequest& request, const std::string& path, const std::string& query, const Reply& reply);
  void answer_command(const std::variant<ClientMessage, MessageRefusal>& parsed, Role role, const Reply& reply);
  void explain(const std::string& query, Role role, const Reply& reply);
  void import_areas(const HttpRequest& request, Role role, const Reply& reply);
  [[nodiscard]] HttpAnswer areas() const;
  [[nodiscard]] HttpAnswer mission(const HttpRequest& request, const std::string& query) const;
  [[nodiscard]] HttpAnswer page_file(const HttpRequest& request, const std::string& path) const;

  Hub& hub_;
  const Gate& gate_;
  const Page& page_;
};

/// The refusal of a request whose headers or body have more bytes than the server reads.
[[nodiscard]] HttpAnswer too_large();

/// The headers that every answer has: what browsers may do with it, and who may show it.
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& security_headers();

}  // namespace vigil::console
