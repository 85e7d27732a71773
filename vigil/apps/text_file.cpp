#include "vigil/apps/text_file.hpp"

#include <fstream>

#include <fmt/format.h>

#include "vigil/apps/failure.hpp"

namespace vigil::apps {

void write_whole(const std::filesystem::path& path, std::string_view text) {
  std::filesystem::path unfinished = path;
  unfinished += ".unfinished";
  std::ofstream file(unfinished, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(unfinished, path, error);
  if (file && !error) return;
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
  throw Failure(kComponentFailed,
                fmt::format("{}: cannot be written; make room or choose another place", path.string()));
}

std::string read_whole(const std::filesystem::path& path, std::uintmax_t most_bytes) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most_bytes)
    throw Failure(kComponentFailed,
                  fmt::format("{}: has {} bytes, more than the {} that it may have", path.string(), size, most_bytes));
  std::string text(error ? 0 : static_cast<std::size_t>(size), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !file) throw Failure(kComponentFailed, fmt::format("{}: cannot be read", path.string()));
  return text;
}

}  // namespace vigil::apps
