// What an error or another text says.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace hullbench::testing {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Expects that these words are in `text`.
inline void expect_says(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << "\"" << words << "\" is not in: " << text;
}

inline constexpr const char* kNoComplaint = "nothing";

/// What the Error says that `work()` throws; kNoComplaint when it throws none.
template <typename Error = std::runtime_error, typename Work>
std::string complaint_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return kNoComplaint;
}

/// Expects that `work()` throws an Error that has these words.
template <typename Error = std::runtime_error, typename Work>
void expect_complaint(const Work& work, const std::string& words) {
  const std::string said = complaint_of<Error>(work);
  EXPECT_NE(said, kNoComplaint);
  expect_says(said, words);
}

}  // namespace hullbench::testing
