// Who a process is, in a word that outlives it: for marks on what it leaves behind.
#pragma once

#include <string>

namespace hullbench {

/// This process: "<process namespace>-<process id>-<start time>", digits only, which no other process on this
/// machine shares, whenever it runs.
std::string process_identity();

/// Whether the process of that identity lives. In doubt it does: one of another namespace (a container)
/// cannot be seen from here, and a text that is no identity names nobody who could be known to have ended.
bool is_process_alive(const std::string& identity);

}  // namespace hullbench
