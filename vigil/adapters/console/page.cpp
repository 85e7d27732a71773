#include "vigil/adapters/console/page.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "vigil/adapters/console/access.hpp"

namespace vigil::console {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
}};

std::string_view type_of(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  for (const auto& [ending, type] : kTypes)
    if (ending == extension) return type;
  return "application/octet-stream";
}

/// FNV-1a: tells versions of a file apart, no more.
std::string tag_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("\"{:016x}\"", hash);
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

Page::Page(const std::filesystem::path& folder) {
  std::error_code error;
  std::uintmax_t size = 0;
  for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->is_regular_file()) continue;
    size += it->file_size();
    if (size > kMostBytes)
      throw SetupError(
          fmt::format("{}: has more than {} bytes; is this the console's page?", folder.string(), kMostBytes));
    const std::string name = "/" + it->path().lexically_relative(folder).generic_string();
    auto bytes = std::make_shared<const std::string>(read(it->path()));
    const std::string tag = tag_of(*bytes);
    files_.emplace(name,
                   PageFile{std::string(type_of(it->path())), std::move(bytes), tag, name.starts_with("/assets/")});
  }
}

const PageFile* Page::find(std::string_view path) const {
  const auto found = files_.find(path == "/" ? std::string_view("/index.html") : path);
  return found == files_.end() ? nullptr : &found->second;
}

}  // namespace vigil::console
