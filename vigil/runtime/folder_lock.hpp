#pragma once

#include <filesystem>
#include <optional>

namespace vigil::runtime {

/// A folder that this program alone uses, as far as other programs ask: an exclusive lock of a file in it. The system
/// releases it when the program ends, however it ends.
class FolderLock {
 public:
  /// Nothing where another holder has it. Throws std::system_error where the folder cannot be locked at all.
  [[nodiscard]] static std::optional<FolderLock> take(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;  ///< -1: moved from
};

}  // namespace vigil::runtime
