// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/rules/passing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sil/match/team/plane.hpp"
#include "sil/world/field_specs.hpp"

namespace striker::sil {

namespace {

constexpr double at_the_ball_m = 0.5;
constexpr double sender_m = 1.0;
constexpr double free_m = 0.5;
constexpr double close_m = 0.3 * field_half_length_m;  // 1.17
constexpr Vec2 shooting_at = {4.0, 0.0};
constexpr double hardly_moved_squared_m2 = 5e-6;
constexpr int kick_frames = 10;
constexpr int standing_frames = 5;

constexpr GoToGains following = {1.0, 3.0, 0.6, false};
constexpr GoToGains dribbling = {1.4, 5.0, 0.8, false};
constexpr GoToGains kicking = {1.4, 5.0, 0.8, true};
constexpr GoToGains freeing = {1.4, 3.5, 0.4, false};

Vec2 place(const Sight& sight, std::size_t id) {
  return place_of(sight.now.own[id]);
}

bool may_shoot(const Sight& sight, std::size_t id) {
  return has_shoot_chance(place(sight, id), sight.now.ball);
}

// The side of the target is lost in the arc cosine; front and back count alike, within 45 degrees.
bool faces(const Pose& robot, Vec2 target) {
  const double distance = distance_m(place_of(robot), target);
  const double angle_rad = distance == 0.0 ? robot.heading_rad : std::acos((target.x - robot.x_m) / distance);
  const double off_rad = std::abs(wrapped_rad(angle_rad - robot.heading_rad));
  return off_rad < radians(45.0) || off_rad > radians(135.0);
}

// Where the receiver waits for the ball: as many frames on as it is metres away, if it comes.
Vec2 receive_point(const Sight& sight, std::size_t id) {
  const double distance = distance_m(place(sight, id), sight.now.ball);
  const double distance_before = distance_m(place_of(sight.before.own[id]), sight.before.ball);
  Vec2 point = ball_in_frames(sight, distance < distance_before ? std::min(distance, 15.0) : 5.0);
  const Vec2 goal = {field_half_length_m, 0.0};
  if (distance_m(sight.now.ball, goal) > distance_m(sight.before.ball, goal)) {
    point.x -= 0.15;
  }
  return point;
}

std::optional<std::size_t> nearest_to_ball_soon(const Sight& sight, std::span<const std::size_t> active) {
  const Vec2 soon = ball_in_frames(sight, 3.0);
  std::optional<std::size_t> nearest;
  double least_m = sender_m;
  for (std::size_t i = 0; i < active.size(); ++i) {
    const double distance = distance_m(place(sight, active[i]), soon);
    if (distance < least_m) {
      least_m = distance;
      nearest = i + 1;
    }
  }
  return nearest;
}

bool is_free(const Sight& sight, std::size_t id) {
  for (std::size_t opponent = 1; opponent < robots_a_team; ++opponent) {
    if (distance_m(place(sight, id), place_of(sight.now.opponents[opponent])) < free_m) {
      return false;
    }
  }
  return true;
}

std::optional<std::size_t> free_one_nearest_to_ball(const Sight& sight, std::span<const std::size_t> active,
                                                    std::size_t sender) {
  std::optional<std::size_t> nearest;
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (active[i] == sender || !is_free(sight, active[i])) {
      continue;
    }
    const double distance = distance_m(place(sight, i + 1), sight.now.ball);
    if (distance < least_m) {
      least_m = distance;
      nearest = i + 1;
    }
  }
  return nearest;
}

bool is_stuck(const Sight& sight, std::size_t id) {
  const Pose& now = sight.now.own[id];
  const Pose& before = sight.before.own[id];
  const Vec2 moved = {now.x_m - before.x_m, now.y_m - before.y_m};
  return moved.x * moved.x + moved.y * moved.y < hardly_moved_squared_m2 && now.y_m > 0.0;
}

}  // namespace

std::array<std::optional<Action>, robots_a_team> PassingPlay::play(const Sight& sight, int frame) {
  frame_ = frame;
  actions_ = {};
  std::array<std::size_t, robots_a_team> ids = {};
  std::size_t count = 0;
  for (std::size_t id = 1; id < robots_a_team; ++id) {
    if (sight.now.active[id]) {
      ids[count++] = id;
    }
  }
  const std::span<const std::size_t> active(ids.data(), count);
  choose(sight, active);
  if (sender_ && receiver_) {
    act(sight);
  }
  for (const std::size_t id : active) {
    if (id != sender_ && id != receiver_ && is_stuck(sight, id)) {
      actions_[id] = GoTo{{0.0, 0.0}, freeing};
    }
  }
  return actions_;
}

void PassingPlay::choose(const Sight& sight, std::span<const std::size_t> active) {
  if (ends_at_frame_ == frame_) {
    ends_at_frame_ = 0;
  }
  const bool is_over = ends_at_frame_ > 0 && ends_at_frame_ < frame_;
  if (is_over || (sender_ && !may_shoot(sight, *sender_))) {
    sender_.reset();
    receiver_.reset();
  }
  if (std::ranges::any_of(active, [&](std::size_t id) {
        return distance_m(place(sight, id), sight.now.ball) < at_the_ball_m;
      })) {
    sender_ = nearest_to_ball_soon(sight, active);
  }
  if (sender_ && !receiver_) {
    receiver_ = free_one_nearest_to_ball(sight, active, *sender_);
  }
}

void PassingPlay::act(const Sight& sight) {
  if (sender_before_ == receiver_ || receiver_before_ == sender_) {
    sender_ = sender_before_;
    receiver_ = receiver_before_;
  }
  receive(sight);
  send(sight);
  sender_before_ = sender_;
  receiver_before_ = receiver_;
}

void PassingPlay::receive(const Sight& sight) {
  if (!receiver_) {
    return;
  }
  const std::size_t id = *receiver_;
  const Pose& robot = sight.now.own[id];
  if (sender_ && may_shoot(sight, *sender_)) {
    drop_receiver();
  } else if (may_shoot(sight, id)) {
    shoot(sight, id);
  } else if (sender_ && faces(sight.now.own[*sender_], place_of(robot)) &&
             faces(robot, place(sight, *sender_))) {
    const bool looks_left = robot.heading_rad > 0.0 || robot.heading_rad < -3.0;
    const Pose& before = sight.before.own[id];
    go(id, {{before.x_m, before.y_m + (looks_left ? -field_half_width_m : field_half_width_m)}, following});
  } else if (distance_m(place_of(robot), sight.now.ball) > close_m) {
    go(id, {sender_ ? receive_point(sight, id) : sight.now.ball, following});
  } else if (!faces(robot, sight.now.ball)) {
    go(id, {ball_in_frames(sight, 3.0), following});
  } else {
    go(id, {sight.now.ball, dribbling});
  }
}

void PassingPlay::send(const Sight& sight) {
  if (!sender_) {
    return;
  }
  const std::size_t id = *sender_;
  if (may_shoot(sight, id)) {
    shoot(sight, id);
  } else if (receiver_ && distance_m(place(sight, id), place(sight, *receiver_)) < 0.3 &&
             !sight.now.touching[*receiver_]) {
    kick(sight, id);
  } else if (!faces(sight.now.own[id], sight.now.ball)) {
    go(id, {ball_in_frames(sight, 3.0), following});
  } else {
    go(id, {sight.now.ball, dribbling});
  }
}

void PassingPlay::shoot(const Sight& sight, std::size_t id) {
  if (distance_m(place(sight, id), shooting_at) > close_m) {
    go(id, {sight.now.ball, dribbling});
  } else {
    kick(sight, id);
  }
}

void PassingPlay::go(std::size_t id, const GoTo& way) {
  if (stands_[id]) {
    stand(id);
  } else {
    actions_[id] = way;
  }
}

void PassingPlay::kick(const Sight& sight, std::size_t id) {
  if (stands_[id]) {
    stand(id);
    return;
  }
  if (has_kicked_[id]) {
    stands_[id] = true;
    actions_[id] = Stand{};
    return;
  }
  if (ends_at_frame_ == 0) {
    ends_at_frame_ = frame_ + kick_frames;
  }
  has_kicked_[id] = sight.now.touching[id];
  actions_[id] = GoTo{sight.now.ball, kicking};
}

void PassingPlay::stand(std::size_t id) {
  actions_[id] = Stand{};
  if (ends_at_frame_ == 0) {
    ends_at_frame_ = frame_ + standing_frames;
  }
  if (ends_at_frame_ - 1 == frame_) {
    stands_[id] = false;
  }
}

void PassingPlay::drop_receiver() {
  stands_[*receiver_] = false;
  receiver_.reset();
}

}  // namespace striker::sil
