#include "vigil/adapters/recording/bag_folder.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "vigil/adapters/recording/recording_error.hpp"
#include "vigil/runtime/mission_error.hpp"
#include "vigil/runtime/yaml_tree.hpp"

namespace vigil::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1'000'000;
constexpr std::streamsize kMostMetadataBytes = std::streamsize{4} << 20U;

std::string name_of(std::size_t number) { return fmt::format("recording_{}.db3", number); }

/// 12 of "recording_12.db3"; none of any other name.
std::optional<std::size_t> number_in(const std::string& name) {
  constexpr std::string_view kBefore = "recording_";
  if (!name.starts_with(kBefore)) return std::nullopt;
  std::size_t number = 0;
  const auto read = std::from_chars(name.data() + kBefore.size(), name.data() + name.size(), number);
  return read.ec == std::errc() && number < kMostFiles && name == name_of(number) ? std::optional(number)
                                                                                  : std::nullopt;
}

std::string beginning_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(kMostMetadataBytes), '\0');
  in.read(text.data(), kMostMetadataBytes);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// How many files metadata.yaml names, by the highest number in it; 0 where it says nothing.
std::size_t count_in_metadata(const fs::path& path) {
  try {
    const runtime::YamlNode document = runtime::parse_yaml(beginning_of(path), path.string());
    const runtime::YamlNode* bag = document.find("rosbag2_bagfile_information");
    const runtime::YamlNode* names = bag == nullptr ? nullptr : bag->find("relative_file_paths");
    std::size_t count = 0;
    if (names != nullptr)
      for (const runtime::YamlNode& name : names->items)
        if (const auto number = number_in(name.text)) count = std::max(count, *number + 1);
    return count;
  } catch (const runtime::MissionError&) {
    return 0;
  }
}

}  // namespace

BagFolder look_into(const fs::path& folder) {
  std::map<std::size_t, fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (const auto number = number_in(entry.path().filename().string())) found.emplace(*number, entry.path());
  const std::size_t named = count_in_metadata(folder / "metadata.yaml");
  if (found.empty() && named > 0)
    throw RecordingError(fmt::format("{}: {} is missing, and all files after it; bring them back from a copy",
                                     folder.string(), name_of(0)));
  if (found.empty())
    throw RecordingError(fmt::format(
        "{}: no recording here; name a directory that `vigil simulate --out` or `vigil serve --record` wrote",
        folder.string()));
  BagFolder bag;
  const std::size_t count = std::max(found.rbegin()->first + 1, named);
  for (std::size_t number = 0; number < count; ++number)
    if (!found.contains(number)) bag.missing.push_back(name_of(number));
  for (auto& [number, path] : found) bag.files.push_back(std::move(path));
  return bag;
}

}  // namespace vigil::recording
