// The folder of a private server: its name says whose it is, so that nobody's leftovers stay for ever.
#pragma once

#include <filesystem>
#include <string>

namespace hullbench {

/// The name, without its folder, as mkdtemp takes it: `hullbench-postgres-OWNER-XXXXXX`, where the owner is a
/// process as process_identity names it.
std::string server_folder_template(const std::string& owner);

/// A new folder in `base`, open to this user alone. Throws std::system_error.
std::filesystem::path make_server_folder(const std::filesystem::path& base, const std::string& owner);

/// Kills every process that works in `folder` and removes the folder.
void remove_server_folder(const std::filesystem::path& folder);

/// Does that with the folders in `base` that belong to this user and whose owner has ended. A folder of
/// another process namespace (a container that shares the folder) is left alone: whether its owner lives
/// cannot be seen.
void remove_stale_server_folders(const std::filesystem::path& base);

}  // namespace hullbench
