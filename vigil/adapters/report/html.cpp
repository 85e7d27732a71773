#include "vigil/adapters/report/html.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace vigil::report {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t found = text.find(from); found != std::string::npos; found = text.find(from, at)) {
    out.append(text, at, found - at);
    out += to;
    at = found + from.size();
  }
  text = out.append(text, at);
}

void remove_between(std::string& text, std::string_view from, std::string_view to) {
  const std::size_t begin = text.find(from);
  const std::size_t end = begin == std::string::npos ? begin : text.find(to, begin);
  if (end != std::string::npos) text.erase(begin, end + to.size() - begin);
}

std::string table_row(const std::vector<std::string>& cells, std::string_view tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text + "</tr>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return out;
}

std::string escaped_with_code(std::string_view text) {
  std::string out;
  bool in_code = false;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t quote = text.find('`', at);
    out += escaped(text.substr(at, quote - at));
    if (quote == std::string_view::npos) break;
    out += in_code ? "</code>" : "<code>";
    in_code = !in_code;
    at = quote + 1;
  }
  return in_code ? out + "</code>" : out;
}

std::string inline_svg(std::string svg, std::string_view prefix, std::string_view label) {
  remove_between(svg, "<?xml", "?>");
  remove_between(svg, "<title>", "</title>");
  remove_between(svg, "<desc>", "</desc>");
  remove_between(svg, " width=\"", "\"");
  remove_between(svg, " height=\"", "\"");
  for (const char quote : {'\'', '"'}) {
    replace_all(svg, fmt::format(" id={}", quote), fmt::format(" id={}{}", quote, prefix));
    replace_all(svg, fmt::format("href={}#", quote), fmt::format("href={}#{}", quote, prefix));
    replace_all(svg, fmt::format("{0}black{0}", quote), fmt::format("{0}currentColor{0}", quote));
  }
  for (const char* black : {"rgb(  0,   0,   0)", "rgb(0,0,0)"}) replace_all(svg, black, "currentColor");
  replace_all(svg, "url(#", fmt::format("url(#{}", prefix));
  replace_all(svg, "<svg", fmt::format("<svg role=\"img\" aria-label=\"{}\"", escaped(label)));
  // Only the embedded pictures' data remain of what could name another place.
  replace_all(svg, "xmlns=\"http://www.w3.org/2000/svg\"", "");
  replace_all(svg, "xmlns:xlink=\"http://www.w3.org/1999/xlink\"", "");
  replace_all(svg, "xlink:href", "href");
  return svg;
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string text = "<div class=\"scroll\"><table>\n<thead>" + table_row(rows.front(), "th") + "</thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) text += table_row(rows[i], "td");
  return text + "</tbody></table></div>\n";
}

}  // namespace vigil::report
