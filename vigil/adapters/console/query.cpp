#include "vigil/adapters/console/query.hpp"

#include <algorithm>
#include <charconv>

namespace vigil::console {
namespace {

std::optional<std::string> decoded(std::string_view text) {
  std::string plain;
  for (; !text.empty(); text.remove_prefix(1)) {
    if (text.front() != '%') {
      plain += text.front();
      continue;
    }
    unsigned char byte = 0;
    const std::string_view digits = text.substr(1, 2);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() < 2 || read.ptr != digits.data() + digits.size()) return std::nullopt;
    plain += static_cast<char>(byte);
    text.remove_prefix(2);
  }
  return plain;
}

}  // namespace

std::optional<std::string> query_value(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), part.size() + 1));
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos && part.substr(0, equals) == name) return decoded(part.substr(equals + 1));
  }
  return std::nullopt;
}

}  // namespace vigil::console
