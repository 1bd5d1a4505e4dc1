// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "sil/match/play/robot_kind.hpp"
#include "sil/match/play/slip_plant.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

// AI Soccer takes a robot for fallen that tilts by 36.9 degrees or more: its up vector's vertical share is 0.8.
constexpr double standing_up = 0.8;

std::unique_ptr<Plant> make_match_plant(const MatchPlan& plan, std::size_t robot) {
  auto plant = make_plant(plan.plant, robot, robot_spec(kind_of(robot).role));
  if (plan.header.slip == 0.0) {
    return plant;
  }
  return std::make_unique<SlipPlant>(std::move(plant), plan.header.slip,
                                     Random(plan.header.seed, robot, random_stream::match_slip));
}

// AI Soccer's contacts throw robots off a ball that is held; the official rules mend that too.
WorldConfig world_of(const MatchPlan& plan) {
  const auto plant = make_plant(plan.plant, 0, robot_spec(Role::forward));
  WorldConfig config = match_world(plant->ticks_per_step() * tick_s);
  config.ball_can_be_held = plan.header.rule_set == "official";
  return config;
}

bool plays_to_plus_x(Team team, int half) {
  return (team == Team::red) == (half == 1);
}

RobotOrder in_field_frame(const RobotOrder& order, Team team, int half) {
  RobotOrder result = order;
  if (auto* motion = std::get_if<MotionOrder>(&result); motion != nullptr && !plays_to_plus_x(team, half)) {
    motion->target = turned(motion->target);
  }
  return result;
}

bool stands_still(const Ruling& ruling) {
  return ruling.state == GameState::pause || ruling.state == GameState::over;
}

}  // namespace

MatchRun::MatchRun(const MatchPlan& plan, const MatchParts& parts)
    : plan_(plan),
      parts_(parts),
      world_(world_of(plan)),
      referee_(plan.header.rules),
      jitter_(plan.header.seed, 0, random_stream::match_jitter) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    robots_.push_back(std::make_unique<MatchRobot>(robot, *kind_of(robot).description,
                                                   make_match_plant(plan, robot), *parts.links[robot],
                                                   RobotFaults{plan.faults[robot], plan.header.seed}));
  }
}

MatchEnd MatchRun::run(const std::function<bool()>& stop) {
  for (MatchObserver* record : parts_.records) {
    record->begin(plan_.header);
  }
  begin();
  while (ruling().state != GameState::over && !stop()) {
    see_frame();
    end_frame();
  }
  if (ruling().state != GameState::over) {
    run_tick();  // in which the last frame's orders go out: a replay takes them from the buses
  }
  const MatchEnd end{.complete = ruling().state == GameState::over, .state_hash = world_.state_hash()};
  for (MatchObserver* record : parts_.records) {
    record->end(end);
  }
  for (Observer* bus : parts_.buses) {
    bus->end_run();
  }
  return end;
}

void MatchRun::begin() {
  follow(ruling());
  tell(ruling(), {});
  seen_ = look();
  show_frame(seen_, {});
}

void MatchRun::see_frame() {
  run_frame();
  ++frame_;
  seen_ = look();
}

void MatchRun::end_frame() {
  const auto orders = ask_teams();
  touched_before_ = seen_.touching;
  world_.clear_touches();
  follow(referee_.step(seen_));
  tell(ruling(), orders);
  show_frame(seen_, orders);
}

RefereeFrame MatchRun::look() const {
  RefereeFrame seen;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    seen.robots[robot] = world_.robot_pose(robot);
    seen.standing[robot] = world_.robot_up(robot) > standing_up;
    seen.touching[robot] = world_.touched_ball(robot);
  }
  const auto [position_m, velocity_m_s] = world_.ball_in_space();
  seen.ball = {.position_m = {position_m.x, position_m.y},
               .height_m = position_m.z,
               .speed_m_s = std::hypot(velocity_m_s.x, velocity_m_s.y, velocity_m_s.z)};
  return seen;
}

TeamView MatchRun::view(Team team) const {
  RefereeFrame shown = seen_;
  shown.touching = touched_before_;
  return view_of(team, shown, ruling());
}

// With the ruling of the frame before, and the touches that it saw.
std::array<std::optional<TeamOrders>, 2> MatchRun::ask_teams() {
  std::array<std::optional<TeamOrders>, 2> orders;
  const Ruling& before = ruling();
  const bool tells_of_the_end =
      before.reset_reason == ResetReason::half_time || before.reset_reason == ResetReason::game_end;
  if (stands_still(before) && !tells_of_the_end) {
    return orders;
  }
  for (const Team team : teams) {
    const TeamOrders answer = parts_.teams[index_of(team)]->play(view(team));
    if (!stands_still(before)) {
      orders[index_of(team)] = answer;
    }
  }
  return orders;
}

// Places who is placed, and says who is to be free.
void MatchRun::follow(const Ruling& ruling) {
  const Placements& placements = ruling.placements;
  const auto is_placed = [](const std::optional<Pose>& pose) { return pose.has_value(); };
  const bool is_formation = std::ranges::all_of(placements.robots, is_placed) && placements.ball;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const auto& pose = placements.robots[robot];
    if (pose && ruling.sent_out[robot]) {
      world_.remove_robot(robot, *pose);
      on_field_.reset(robot);
    } else if (pose) {
      place(robot, *pose, is_formation);
    }
  }
  if (placements.ball) {
    world_.drop_ball(placements.ball->position_m, placements.ball->height_m);
  }
  settles_ = ruling.state == GameState::pause && (settles_ || placements.ball);
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    robots_[robot]->is_wanted(on_field_[robot] && (settles_ || !stands_still(ruling)));
  }
}

void MatchRun::place(std::size_t robot, const Pose& pose, bool with_jitter) {
  Pose spot = pose;
  if (with_jitter) {
    const MatchHeader& header = plan_.header;
    spot.x_m += jitter_.uniform(-header.jitter_m, header.jitter_m);
    spot.y_m += jitter_.uniform(-header.jitter_m, header.jitter_m);
    spot.heading_rad += jitter_.uniform(-header.jitter_rad, header.jitter_rad);
  }
  world_.place_robot(robot, spot);
  on_field_.set(robot);
  robots_[robot]->was_placed();
}

void MatchRun::tell(const Ruling& ruling, const std::array<std::optional<TeamOrders>, 2>& orders) {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (!on_field_[robot]) {
      continue;
    }
    robots_[robot]->sees(world_, tick_);
    const Team team = team_of(robot);
    const auto& answer = orders[index_of(team)];
    if (!ruling.may_move(robot) || !answer) {
      robots_[robot]->is_told(SpeedOrder{}, tick_);
    } else if (const auto& order = (*answer)[id_of(robot)]) {
      robots_[robot]->is_told(in_field_frame(*order, team, ruling.half), tick_);
    }
  }
}

void MatchRun::show_frame(const RefereeFrame& seen, const std::array<std::optional<TeamOrders>, 2>& orders) {
  std::array<RobotRecord, robots_in_match> robots;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    robots[robot] = robots_[robot]->take_record(world_, tick_);
  }
  const Vec3 ball_m_s = world_.ball_in_space().velocity_m_s;
  const MatchFrame frame{.number = frame_,
                         .seen = seen,
                         .ruling = ruling(),
                         .ball_velocity_m_s = {ball_m_s.x, ball_m_s.y, ball_m_s.z},
                         .robots = robots,
                         .orders = orders};
  for (MatchObserver* record : parts_.records) {
    record->frame(frame);
  }
}

void MatchRun::run_frame() {
  for (std::uint32_t i = 0; i < core::decision_period_ticks; ++i) {
    run_tick();
  }
}

void MatchRun::run_tick() {
  for (Observer* bus : parts_.buses) {
    bus->begin_tick();
  }
  for (const auto& robot : robots_) {
    robot->begin_tick(tick_);
  }
  for (const auto& robot : robots_) {
    robot->end_tick(tick_);
  }
  if (tick_ % robots_.front()->ticks_per_step() == 0) {
    move_world();
  }
  if (!parts_.buses.empty()) {
    show_tick();
  }
  ++tick_;
}

void MatchRun::move_world() {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (on_field_[robot]) {
      robots_[robot]->actuate(world_, tick_);
    }
  }
  world_.step();
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    if (on_field_[robot]) {
      robots_[robot]->sense(world_);
    }
  }
}

void MatchRun::show_tick() {
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    snapshots_[robot] = {.pose = world_.robot_pose(robot),
                         .velocity_m_s = world_.robot_velocity_m_s(robot),
                         .frames = robots_[robot]->traffic()};
  }
  const Snapshot snapshot{.tick = tick_, .robots = snapshots_, .ball = world_.ball()};
  for (Observer* bus : parts_.buses) {
    bus->end_tick(snapshot);
  }
}

}  // namespace striker::sil
