// SPDX-License-Identifier: Apache-2.0
// A player program as a team: one that plays, and those that are slow, silent, gone, or say nonsense.
#include "sil/match/team/tcp/tcp_strategy.hpp"

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "sil/match/team/strategies.hpp"
#include "tests/match/team/tcp/test_player.hpp"
#include "tests/match/team/views.hpp"

namespace striker::sil {
namespace {

using namespace std::chrono_literals;

constexpr auto long_enough = 20s;  // where nobody is to be late
constexpr auto soon = 100ms;

TcpOptions options(std::chrono::milliseconds answer_timeout = long_enough) {
  return {.port = 0, .answer_timeout = answer_timeout, .ready_timeout = long_enough};
}

TeamOrders all(double speed_m_s) {
  TeamOrders orders;
  orders.fill(SpeedOrder{speed_m_s, speed_m_s});
  return orders;
}

std::chrono::duration<double> time_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::steady_clock::now() - begin;
}

TEST(TcpPlayer, PlaysInLockstep) {
  TcpStrategy team(options());
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.get_ready();
    for (int frame = 1; frame <= 3; ++frame) {
      EXPECT_NE(self.hear().find("coordinates"), std::string::npos);
      std::this_thread::sleep_for(20ms);
      self.say("aiwc.commentate(\"k\", \"on we go\")");
      self.say(speeds(frame / 4.0));
    }
  });
  for (int frame = 1; frame <= 3; ++frame) {
    EXPECT_EQ(team.play(home_view()), all(frame / 4.0));
  }
  EXPECT_EQ(team.frames_without_answer(), 0);
}

// Without the stop this would wait for an hour.
TEST(TcpPlayer, AStopEndsTheWaitForAPlayerWhoDoesNotCome) {
  int looks = 0;
  TcpOptions patient = options();
  patient.ready_timeout = 1h;
  patient.stop = [&] { return ++looks > 2; };
  TcpStrategy team(patient);
  EXPECT_EQ(team.play(home_view()), TeamOrders{});
  EXPECT_EQ(looks, 3);
}

TEST(TcpPlayer, TakesWheelsAndNoKicks) {
  TcpStrategy team(options());
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.get_ready();
    (void)self.hear();
    self.say("aiwc.set_speeds(\"k\", 1, 2, 10, 9, 3, 4, 10, 9, 5, 6, 10, 9, 7, 8, 10, 9, 9, 10, 10, 9)");
  });
  const TeamOrders orders = team.play(home_view());
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    const double left = 2.0 * static_cast<double>(id) + 1.0;
    EXPECT_EQ(std::get<SpeedOrder>(orders[id].value()), (SpeedOrder{left, left + 1.0}));
  }
}

TEST(TcpPlayer, IsToldTheEnd) {
  std::string last;
  {
    auto team = std::make_unique<TcpStrategy>(options());
    TestPlayer player(team->port(), [&last](TestPlayer& self) {
      self.get_ready();
      (void)self.hear();
      self.say(speeds(0.0));
      last = self.hear();
      EXPECT_EQ(self.hear(), "");  // it hung up
    });
    (void)team->play(home_view());
    team.reset();
  }
  EXPECT_NE(last.find("\"reset_reason\":4"), std::string::npos) << last;
}

TEST(TcpPlayer, ThatIsSilentCostsItsOwnOrders) {
  TcpStrategy team(options(soon));
  std::atomic<bool> is_over = false;
  TestPlayer player(team.port(), [&is_over](TestPlayer& self) {
    self.get_ready();
    while (!is_over) {
      std::this_thread::sleep_for(5ms);
    }
  });
  const auto took = time_of([&] { EXPECT_EQ(team.play(home_view()), TeamOrders{}); });
  EXPECT_GE(took, soon);
  EXPECT_LT(took, 5s);
  EXPECT_EQ(team.play(home_view()), TeamOrders{});
  EXPECT_EQ(team.frames_without_answer(), 2);
  is_over = true;
}

// Its first answer comes when the first frame is over, and is not the second one's.
TEST(TcpPlayer, ThatIsSlowCostsTheOrdersOfThatFrameAlone) {
  TcpStrategy team(options(soon));
  std::atomic<int> frame = 0;
  std::atomic<int> answered = 0;
  TestPlayer player(team.port(), [&](TestPlayer& self) {
    self.get_ready();
    (void)self.hear();
    while (frame < 1) {
      std::this_thread::sleep_for(1ms);
    }
    self.say(speeds(1.0));
    answered = 1;
    (void)self.hear();
    self.say(speeds(2.0));
  });
  EXPECT_EQ(team.play(home_view()), TeamOrders{});
  frame = 1;
  while (answered < 1) {
    std::this_thread::sleep_for(1ms);
  }
  std::this_thread::sleep_for(20ms);  // on its way
  EXPECT_EQ(team.play(home_view()), all(2.0));
  EXPECT_EQ(team.frames_without_answer(), 1);
}

TEST(TcpPlayer, ThatHangsUpIsGoneAndWaitedForNoMore) {
  TcpStrategy team(options());
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.get_ready();
    (void)self.hear();
    self.say(speeds(1.0));
  });
  EXPECT_EQ(team.play(home_view()), all(1.0));
  const auto took = time_of([&] {
    for (int frame = 0; frame < 100; ++frame) {
      EXPECT_EQ(team.play(home_view()), TeamOrders{});
    }
  });
  EXPECT_LT(took, 5s);
  EXPECT_FALSE(team.is_connected());
}

TEST(TcpPlayer, ThatHangsUpInTheMiddleOfItsAnswerGivesNone) {
  TcpStrategy team(options());
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.get_ready();
    (void)self.hear();
    self.say("aiwc.set_speeds(\"k\", 1, 1, 0, 0, 1, 1");
  });
  EXPECT_EQ(team.play(home_view()), TeamOrders{});
}

TEST(TcpPlayer, ThatSaysGarbageIsHungUpOn) {
  for (const char* const garbage : {"hello?", "aiwc.set_speeds(\"k\", one, two)", "{\"speeds\": []}"}) {
    SCOPED_TRACE(garbage);
    TcpStrategy team(options());
    TestPlayer player(team.port(), [garbage](TestPlayer& self) {
      self.get_ready();
      (void)self.hear();
      self.say(garbage);
      EXPECT_EQ(self.hear(), "");
    });
    EXPECT_EQ(team.play(home_view()), TeamOrders{});
    EXPECT_FALSE(team.is_connected());
    EXPECT_EQ(team.play(home_view()), TeamOrders{});
  }
}

TEST(TcpPlayer, ThatSaysWrongSpeedsLosesThoseAlone) {
  TcpStrategy team(options());
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.get_ready();
    for (const std::string& said : {speeds(1.0, 19), speeds(1.0, 21), speeds(1.0, 0), speeds(std::nan("")),
                                    speeds(1e308 * 10.0), speeds(0.5)}) {
      (void)self.hear();
      self.say(said);
    }
  });
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(team.play(home_view()), TeamOrders{}) << frame;
  }
  EXPECT_EQ(team.play(home_view()), all(0.5));
}

// It is neither heard to the end nor kept: each frame ends, and so does the connection, if not by itself.
TEST(TcpPlayer, ThatTalksWithoutEndHoldsUpNobody) {
  for (const char* const talk : {"aiwc.commentate(\"k\", \"and on\")", "aiwc.set_speeds(\"k\", 1)",
                                 "aiwc.get_info()", "aiwc.commentate(\"", " "}) {
    SCOPED_TRACE(talk);
    TcpStrategy team(options(soon));
    TestPlayer player(team.port(), [talk](TestPlayer& self) {
      self.get_ready();
      (void)self.hear();
      std::string much;
      for (int i = 0; i < 100; ++i) {
        much += talk;
      }
      for (int i = 0; i < 1'000 && self.say(much); ++i) {
      }
    });
    do {
      const auto took = time_of([&] { EXPECT_EQ(team.play(home_view()), TeamOrders{}); });
      EXPECT_LT(took, 5s);
    } while (team.is_connected());
  }
}

TEST(TcpPlayer, ThatCommentsWithoutEndIsHungUpOn) {
  TcpStrategy team(options());
  std::atomic<bool> was_hung_up_on = false;
  {
    TestPlayer player(team.port(), [&was_hung_up_on](TestPlayer& self) {
      self.get_ready();
      (void)self.hear();
      const auto end = std::chrono::steady_clock::now() + 5s;
      while (!was_hung_up_on && std::chrono::steady_clock::now() < end) {
        was_hung_up_on = !self.say("aiwc.commentate(\"k\", \"and on\")");
      }
    });
    EXPECT_EQ(team.play(home_view()), TeamOrders{});
  }
  EXPECT_TRUE(was_hung_up_on);
}

TEST(TcpPlayer, ThatNeverComesIsWaitedForOnce) {
  TcpStrategy team({.port = 0, .answer_timeout = long_enough, .ready_timeout = soon});
  const auto took = time_of([&] {
    for (int frame = 0; frame < 100; ++frame) {
      EXPECT_EQ(team.play(home_view()), TeamOrders{});
    }
  });
  EXPECT_GE(took, soon);
  EXPECT_LT(took, 5s);
}

TEST(TcpPlayer, ThatIsNeverReadyIsHungUpOn) {
  TcpStrategy team({.port = 0, .answer_timeout = long_enough, .ready_timeout = soon});
  TestPlayer player(team.port(), [](TestPlayer& self) {
    self.say("aiwc.get_info(\"k\")");
    EXPECT_NE(self.hear(), "");
    EXPECT_EQ(self.hear(), "");
  });
  EXPECT_EQ(team.play(home_view()), TeamOrders{});
  EXPECT_FALSE(team.is_connected());
}

TEST(TcpPlayer, AnswersOnOnePortAlone) {
  const TcpStrategy team(options());
  EXPECT_THROW(TcpStrategy({.port = team.port()}), std::system_error);
}

TEST(TcpPort, IsPartOfTheName) {
  EXPECT_EQ(tcp_port_of("tcp:5003"), 5003);
  EXPECT_EQ(tcp_port_of("rules"), std::nullopt);
  EXPECT_EQ(tcp_port_of("tcp"), std::nullopt);
  for (const char* const name : {"tcp:", "tcp:0", "tcp:65536", "tcp:-1", "tcp:5003x", "tcp: 1", "tcp:five"}) {
    EXPECT_THROW((void)tcp_port_of(name), std::invalid_argument) << name;
  }
}

// A port of the rules in Python, over the protocol: the same orders to the last bit, of all kinds of frames.
TEST(RulesInPython, PlaysAsRulesDoes) {
  auto player = std::make_unique<TcpStrategy>(options());
  const std::string port = std::to_string(player->port());
  std::string words[] = {PYTHON, RULES_PLAYER, "127.0.0.1", port, "key", "/dev/null"};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                       words[4].data(), words[5].data(), nullptr};
  pid_t process = 0;
  ASSERT_EQ(posix_spawn(&process, PYTHON, nullptr, nullptr, arguments, environ), 0);
  const auto rules = make_strategy("rules", 1);
  RandomViews views(31);
  int moved = 0;
  for (int frame = 0; frame < 5'000; ++frame) {
    const TeamView& view = views.next();
    const TeamOrders orders = rules->play(view);
    ASSERT_EQ(player->play(view), orders) << frame;
    moved += orders != TeamOrders{} ? 1 : 0;
  }
  EXPECT_GT(moved, 4'900);
  player.reset();
  int status = -1;
  waitpid(process, &status, 0);
  EXPECT_EQ(status, 0);  // it was told the end
}

}  // namespace
}  // namespace striker::sil
