// Words for messages.
#pragma once

#include <string>
#include <vector>

namespace hullbench {

/// "a, b and c"
std::string join_words(const std::vector<std::string>& words);

/// `words` one after another with `between` them.
template <typename Words>
std::string joined(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// `text` with a full stop at its end.
std::string sentence(std::string text);

}  // namespace hullbench
