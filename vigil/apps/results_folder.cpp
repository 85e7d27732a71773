#include "vigil/apps/results_folder.hpp"

#include <fmt/format.h>

#include "vigil/apps/failure.hpp"
#include "vigil/runtime/mission_error.hpp"

namespace vigil::apps {

namespace fs = std::filesystem;

std::string in_words(const fs::path& path) {
  constexpr std::size_t kMostBytes = 300;
  return runtime::on_one_line(path.string(), kMostBytes);
}

void refuse_existing(const char* option, const fs::path& path) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(path, error)))
    throw Failure(kBadInput, fmt::format("{} {}: is there already; name a directory that is not, or remove it", option,
                                         in_words(path)));
}

void create_results(const char* option, const fs::path& path) {
  refuse_existing(option, path);
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw Failure(kBadInput, fmt::format("{} {}: cannot be created ({}); name a place where you may write", option,
                                         in_words(path), error.message()));
}

}  // namespace vigil::apps
