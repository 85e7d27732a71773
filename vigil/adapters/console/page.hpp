#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace vigil::console {

/// A file of the console's page.
struct PageFile {
  std::string content_type;
  std::shared_ptr<const std::string> bytes;
  std::string tag;             ///< ETag, with its quotes
  bool never_changes = false;  ///< its name holds a hash of what is in it
};

/// The console's page, as it was built: all its files, read once.
class Page {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20U;

  /// Every file below `folder`; no file where there is no such folder. Throws SetupError where it is too large.
  explicit Page(const std::filesystem::path& folder);

  [[nodiscard]] bool is_built() const { return find("/") != nullptr; }
  /// By the path of an address, "/" for index.html; null for what is not there.
  [[nodiscard]] const PageFile* find(std::string_view path) const;

 private:
  std::map<std::string, PageFile, std::less<>> files_;
};

}  // namespace vigil::console
