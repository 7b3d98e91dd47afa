// What an error says.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace hullbench::testing {

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
  EXPECT_NE(said.find(words), std::string::npos) << said;
}

}  // namespace hullbench::testing
