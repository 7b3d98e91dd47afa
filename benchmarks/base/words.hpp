// Words for messages.
#pragma once

#include <string>
#include <vector>

namespace hullbench {

/// "a, b and c"
std::string join_words(const std::vector<std::string>& words);

/// `text` with a full stop at its end.
std::string sentence(std::string text);

}  // namespace hullbench
