// The child process that starts a private PostgreSQL server, waits for its owner to end and leaves nothing
// behind.
#pragma once

#include <filesystem>
#include <string>

namespace hullbench {

struct SupervisorPlan {
  std::filesystem::path bin;   ///< folder of initdb and postgres
  std::filesystem::path base;  ///< where the server's folder is made
  std::string owner;           ///< process_identity() of the process that the server is for
  int lifeline = -1;           ///< read end of a pipe that closes when the owner ends
  int report = -1;             ///< write end of a pipe for one message: "ready FOLDER" or "failed WHY"
};

/// To be called in a freshly forked child. Closes every other file descriptor, so that no pipe of the owner
/// stays open because of the server, and does not return.
[[noreturn]] void supervise(const SupervisorPlan& plan);

}  // namespace hullbench
