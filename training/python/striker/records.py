# SPDX-License-Identifier: Apache-2.0
"""What a reward of one's own is computed from."""

import collections

from striker._native import RECORD_FIELDS

KickRecord = collections.namedtuple("KickRecord", RECORD_FIELDS)
KickRecord.__doc__ = """A decision of a kick, as floats (or, in a VectorKickEnv, arrays of a float a world).

decision           1 to 40: how many were taken in the episode, this one included; 0 in a step that began one
action             this decision's
reward             what the task pays for it
contact            1: the robot has touched the ball in this episode
just_contact       1: in this decision, for the first time
theta_contact_rad  of the first contact: from the target's direction to the line robot centre - ball centre; 0 without one
v_contact_m_s      the robot's speed along its heading at it; 0 without one
front_face         1: it was on the front face
ball_x_m, ball_y_m, robot_speed_m_s, ball_vx_m_s, ball_vy_m_s, ball_angle_rad
                   the six elements of the paper's state after the decision, in the robot's frame, as the learner sees them
decisions_left     39 to 0
terminated, truncated
                   1: the episode ended so
"""
