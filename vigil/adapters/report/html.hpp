#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vigil::report {

/// Text as HTML shows it, whatever is in it.
[[nodiscard]] std::string escaped(std::string_view text);

/// The same, with what stands between back-quotes set as code.
[[nodiscard]] std::string escaped_with_code(std::string_view text);

/// gnuplot's SVG made ready to stand inside a page: without the XML head, its identifiers made unique by `prefix`,
/// black in the colour of the page's text, scaled by the page, with `label` for those who do not see it.
[[nodiscard]] std::string inline_svg(std::string svg, std::string_view prefix, std::string_view label);

/// A table; the first row is its head. Cells are text.
[[nodiscard]] std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace vigil::report
