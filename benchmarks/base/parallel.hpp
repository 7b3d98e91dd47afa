// Work that nobody times, on all cores.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace hullbench {

/// In a list of cores: a thread that stays on no core of its own.
inline constexpr int kAnyCore = -1;

/// Calls `work(i)` for every i below `count`, each once, in any order and on several threads: one on each of
/// `cores` (numbers as in cores.hpp), or one alone when there are none. Returns when all are done. What
/// a call throws is thrown here, after the others have ended; of several exceptions that of the smallest i.
void for_each_in_parallel(std::size_t count, const std::vector<int>& cores,
                          const std::function<void(std::size_t)>& work);

}  // namespace hullbench
