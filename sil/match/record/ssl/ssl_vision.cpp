// SPDX-License-Identifier: Apache-2.0
// Numbers of fields: sil/match/record/proto/ssl_vision.proto and ssl_tracker.proto.
#include "sil/match/record/ssl/ssl_vision.hpp"

#include "sil/match/record/ssl/proto_message.hpp"
#include "sil/match/record/ssl/ssl_geometry.hpp"

namespace striker::sil {
namespace {

float millimetres(double length_m) {
  return static_cast<float>(length_m * 1e3);
}

double time_s(const MatchFrame& frame) {
  return static_cast<double>(frame.ruling.sim_ms) / 1e3;
}

ProtoMessage vector2(Vec2 value) {
  ProtoMessage vector;
  vector.real(1, static_cast<float>(value.x));
  vector.real(2, static_cast<float>(value.y));
  return vector;
}

ProtoMessage vector3(const std::array<double, 3>& value) {
  ProtoMessage vector;
  for (int part = 0; part < 3; ++part) {
    vector.real(part + 1, static_cast<float>(value[static_cast<std::size_t>(part)]));
  }
  return vector;
}

// There is no image: the pixels that SSL asks for are 0.
ProtoMessage detected_ball(const BallSeen& ball) {
  ProtoMessage message;
  message.real(1, 1.0F);  // confidence
  message.real(3, millimetres(ball.position_m.x));
  message.real(4, millimetres(ball.position_m.y));
  message.real(5, millimetres(ball.height_m));
  message.real(6, 0.0F);  // pixel_x
  message.real(7, 0.0F);  // pixel_y
  return message;
}

ProtoMessage detected_robot(std::size_t robot, const Pose& pose) {
  ProtoMessage message;
  message.real(1, 1.0F);  // confidence
  message.number(2, id_of(robot));
  message.real(3, millimetres(pose.x_m));
  message.real(4, millimetres(pose.y_m));
  message.real(5, static_cast<float>(pose.heading_rad));
  message.real(6, 0.0F);  // pixel_x
  message.real(7, 0.0F);  // pixel_y
  message.real(8, millimetres(robot_top_m));
  return message;
}

ProtoMessage detection(const MatchFrame& frame) {
  ProtoMessage message;
  message.number(1, static_cast<std::uint64_t>(frame.number));
  message.real(2, time_s(frame));  // t_capture
  message.real(3, time_s(frame));  // t_sent
  message.number(4, 0);            // camera_id
  message.message(5, detected_ball(frame.seen.ball));
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const int colour = team_of(robot) == Team::red ? 6 : 7;  // robots_yellow, robots_blue
    message.message(colour, detected_robot(robot, frame.seen.robots[robot]));
  }
  return message;
}

ProtoMessage tracked_ball(const MatchFrame& frame) {
  const BallSeen& ball = frame.seen.ball;
  ProtoMessage message;
  message.message(1, vector3({ball.position_m.x, ball.position_m.y, ball.height_m}));
  message.message(2, vector3(frame.ball_velocity_m_s));
  message.real(3, 1.0F);  // visibility
  return message;
}

ProtoMessage tracked_robot(std::size_t robot, const MatchFrame& frame) {
  const Pose& pose = frame.seen.robots[robot];
  ProtoMessage id;
  id.number(1, id_of(robot));
  id.number(2, team_of(robot) == Team::red ? 1 : 2);  // YELLOW, BLUE
  ProtoMessage message;
  message.message(1, id);
  message.message(2, vector2({pose.x_m, pose.y_m}));
  message.real(3, static_cast<float>(pose.heading_rad));
  message.message(4, vector2(frame.robots[robot].velocity_m_s));
  message.real(5, static_cast<float>(frame.robots[robot].turn_rate_rad_s));
  message.real(6, 1.0F);  // visibility
  return message;
}

}  // namespace

std::string vision_packet(const MatchFrame& frame, bool with_geometry) {
  ProtoMessage packet;
  packet.message(1, detection(frame));
  if (with_geometry) {
    packet.message(2, field_geometry());
  }
  return packet.bytes();
}

std::string tracker_packet(const MatchFrame& frame) {
  ProtoMessage tracked;
  tracked.number(1, static_cast<std::uint64_t>(frame.number));
  tracked.real(2, time_s(frame));
  tracked.message(3, tracked_ball(frame));
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    tracked.message(4, tracked_robot(robot, frame));
  }
  ProtoMessage packet;
  packet.text(1, "striker");  // uuid: the same for the same match
  packet.text(2, "striker");  // source_name
  packet.message(3, tracked);
  return packet.bytes();
}

}  // namespace striker::sil
