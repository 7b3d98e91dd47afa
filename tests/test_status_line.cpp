// The line that says what a long work is at.
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

using namespace std::chrono_literals;

/// For longer than a StatusLine of this test is quiet.
void wait() {
  std::this_thread::sleep_for(500ms);
}

TEST(StatusLine, IsRewrittenOnATerminal) {
  std::ostringstream out;
  {
    StatusLine line(out, true);
    line.show("a");
    line.show("b");
    EXPECT_EQ(out.str(), "\r\033[Ka\r\033[Kb");
    line.say("a note");
    line.show("c");
  }
  EXPECT_EQ(out.str(), "\r\033[Ka\r\033[Kb\r\033[Ka note\n\r\033[Kc\r\033[K");
}

TEST(StatusLine, ElsewhereThereIsALineNowAndThen) {
  std::ostringstream out;
  StatusLine line(out, false);
  line.show("a");
  line.show("b");
  line.say("a note");
  EXPECT_EQ(out.str(), "a\na note\n");
}

TEST(StatusLine, ShortWorkShowsNothing) {
  for (const bool terminal : {true, false}) {
    std::ostringstream out;
    {
      StatusLine line(out, terminal, 60s);
      line.show("a");
      line.clear();
      line.show("b");
    }
    EXPECT_EQ(out.str(), "");
  }
}

TEST(StatusLine, LongWorkShowsWhatWasShownLastWhenTheQuietTimeIsOver) {
  for (const bool terminal : {true, false}) {
    std::ostringstream out;
    {
      StatusLine line(out, terminal, 20ms);
      line.show("a");
      line.show("b");
      wait();
    }
    EXPECT_EQ(out.str(), terminal ? "\r\033[Kb\r\033[K" : "b\n");
  }
}

TEST(StatusLine, WhatWasClearedIsNotShown) {
  std::ostringstream out;
  {
    StatusLine line(out, true, 20ms);
    line.show("a");
    line.clear();
    wait();
  }
  EXPECT_EQ(out.str(), "");
}

TEST(StatusLine, WhatComesFasterThanAPersonReadsIsShownAtLast) {
  std::ostringstream out;
  {
    StatusLine line(out, true, 20ms);
    wait();
    line.show("a");
    line.show("b");
    line.show("c");
    wait();
  }
  EXPECT_EQ(out.str(), "\r\033[Ka\r\033[Kc\r\033[K");
}

TEST(StatusLine, NumbersAreDueTwentyTimesASecond) {
  std::ostringstream out;
  StatusLine line(out, true);
  EXPECT_TRUE(line.is_due());
  line.show("1");
  EXPECT_FALSE(line.is_due());
  wait();
  EXPECT_TRUE(line.is_due());
}

}  // namespace
}  // namespace polylidar::tool
