// Words for messages.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hullbench {

/// "a, b and c"
std::string join_words(const std::vector<std::string>& words);

/// `words` one after another with `between` them, each as `text_of` gives it.
template <typename Words, typename TextOf = std::identity>
std::string joined(const Words& words, const std::string& between, const TextOf& text_of = {}) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + std::invoke(text_of, word);
  return text;
}

/// `text` with a full stop at its end.
std::string sentence(std::string text);

}  // namespace hullbench
