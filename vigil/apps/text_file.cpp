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
  throw Failure(kComponentFailed, fmt::format("{}: cannot be written; make room or choose another place", path.string()));
}

}  // namespace vigil::apps
