#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vigil::console {

/// The first value of a name in a URL's query, "a=1&b=two%20words", with its percent signs decoded (RFC 3986, 2.1).
/// None where the name is not there, or where a percent sign is not followed by two hexadecimal digits.
[[nodiscard]] std::optional<std::string> query_value(std::string_view query, std::string_view name);

/// What is wrong with the names in a query, for people; empty where nothing is. A query may have one name once:
/// `known`, or none where that is empty.
[[nodiscard]] std::string query_problem(std::string_view query, std::string_view known);

}  // namespace vigil::console
