// SPDX-License-Identifier: Apache-2.0
// A whole match in Python: one team's orders come from there, the other's from a strategy.
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <string>

#include "sil/match/play/match_links.hpp"
#include "sil/match/play/match_run.hpp"
#include "sil/match/play/match_setting.hpp"
#include "sil/match/team/strategies.hpp"
#include "sil/match/team/top_speed.hpp"
#include "training/python/native/arrays.hpp"
#include "training/python/native/misuse.hpp"
#include "training/python/native/module.hpp"

namespace striker::training {

namespace {

using sil::robots_a_team;

// What a team that is played from outside answers: the orders that were left here.
class LeftOrders final : public sil::Strategy {
 public:
  [[nodiscard]] sil::TeamOrders play(const sil::TeamView&) override { return orders; }
  sil::TeamOrders orders;
};

// A match and all that it plays with.
struct Game {
  Game(const sil::MatchSetting& setting, sil::Team own)
      : links(sil::links_in_process()),
        rival(
            sil::make_strategy(setting.teams[1 - index_of(own)], team_seed(setting, sil::opponent_of(own)))),
        run(plan_of(setting), parts(own)) {
    run.begin();
    run.see_frame();
  }

  sil::MatchParts parts(sil::Team own) {
    sil::MatchParts parts;
    parts.teams[index_of(own)] = &ours;
    parts.teams[1 - index_of(own)] = rival.get();
    for (std::size_t robot = 0; robot < links.size(); ++robot) {
      parts.links[robot] = links[robot].get();
    }
    return parts;
  }

  sil::MatchLinks links;
  LeftOrders ours;
  std::unique_ptr<sil::Strategy> rival;
  sil::MatchRun run;
};

class Match {
 public:
  Match(const std::string& rival, bool is_red, int half_s, const std::string& rules, const std::string& plant,
        double slip, double jitter_mm)
      : own_(is_red ? sil::Team::red : sil::Team::blue) {
    setting_ = {.teams = {"python", "python"},
                .seed = 0,
                .half_s = half_s,
                .rules = rules,
                .plant = plant,
                .slip = slip,
                .jitter_mm = jitter_mm};
    setting_.teams[1 - index_of(own_)] = rival;
    static_cast<void>(sil::make_strategy(rival, 0));  // throws if there is none of that name
  }

  void reset(std::uint64_t seed) {
    const OneAtATime alone(busy_);
    setting_.seed = seed;
    game_ = std::make_unique<Game>(setting_, own_);
  }

  // A frame of 50 ms: a left and a right rim speed a robot, by id. Whether the match is over.
  bool step(const Array<double>& speeds_m_s) {
    const OneAtATime alone(busy_);
    const double* speed = elements(speeds_m_s, 2 * robots_a_team, "actions");
    for (auto& order : game().ours.orders) {
      order = sil::SpeedOrder{.left_m_s = speed[0], .right_m_s = speed[1]};
      speed += 2;
    }
    const py::gil_scoped_release others_may_run;
    game_->run.end_frame();
    if (!is_over()) {
      game_->run.see_frame();
    }
    return is_over();
  }

  // A row a robot, the own five first: x, y, heading, active, touching.
  [[nodiscard]] Array<double> robots() {
    const OneAtATime alone(busy_);
    const sil::TeamView view = game().run.view(own_);
    Array<double> table(std::vector<py::ssize_t>{2 * robots_a_team, 5});
    double* to = table.mutable_data();
    for (const auto* const team : {&view.own, &view.opponents}) {
      for (const sil::RobotView& robot : *team) {
        *to++ = robot.pose.x_m;
        *to++ = robot.pose.y_m;
        *to++ = robot.pose.heading_rad;
        *to++ = robot.active ? 1.0 : 0.0;
        *to++ = robot.touching ? 1.0 : 0.0;
      }
    }
    return table;
  }

  // Ball x, y, height; seconds of the half; half; own and other score; state; has ball.
  [[nodiscard]] std::array<double, 9> situation() {
    const OneAtATime alone(busy_);
    const sil::TeamView view = game().run.view(own_);
    return {view.ball_m.x,
            view.ball_m.y,
            view.ball_height_m,
            view.clock_ms / 1e3,
            static_cast<double>(view.half),
            static_cast<double>(view.score[0]),
            static_cast<double>(view.score[1]),
            static_cast<double>(game_->run.ruling().state),
            view.has_ball ? 1.0 : 0.0};
  }

  [[nodiscard]] double simulated_s() {
    const OneAtATime alone(busy_);
    return game().run.simulated_s();
  }

 private:
  [[nodiscard]] bool is_over() const { return game_->run.ruling().state == sil::GameState::over; }
  [[nodiscard]] Game& game() {
    if (game_ == nullptr) {
      throw std::runtime_error("no match has begun: call reset()");
    }
    return *game_;
  }

  sil::Team own_;
  sil::MatchSetting setting_;
  std::unique_ptr<Game> game_;
  bool busy_ = false;
};

}  // namespace

void add_match(py::module_& module) {
  std::vector<double> top_speeds_m_s;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    top_speeds_m_s.push_back(sil::top_speed_m_s(id));
  }
  module.attr("TOP_SPEEDS_M_S") = py::tuple(py::cast(top_speeds_m_s));
  py::class_<Match>(module, "Match")
      .def(py::init<const std::string&, bool, int, const std::string&, const std::string&, double, double>())
      .def("reset", &Match::reset)
      .def("step", &Match::step, py::arg("speeds_m_s").noconvert())
      .def("robots", &Match::robots)
      .def("situation", &Match::situation)
      .def("simulated_s", &Match::simulated_s);
}

}  // namespace striker::training
