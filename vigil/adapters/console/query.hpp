#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vigil::console {

/// The first value of a name in a URL's query, "a=1&b=two%20words", with its percent signs decoded (RFC 3986, 2.1).
/// None where the name is not there, or where a percent sign is not followed by two hexadecimal digits.
[[nodiscard]] std::optional<std::string> query_value(std::string_view query, std::string_view name);

/// Whether the name has more than one value in the query.
[[nodiscard]] bool names_twice(std::string_view query, std::string_view name);

}  // namespace vigil::console
