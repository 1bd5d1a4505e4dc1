# SPDX-License-Identifier: Apache-2.0
"""Striker's kick in Python: the worlds that striker-train learns in, with Gymnasium's interface, and the way back from a
network to the programs.

    import striker
    env = striker.KickEnv(pose="anywhere", inputs=["ball_x", "ball_y", "robot_speed", "decisions_left"])
    observation, info = env.reset(seed=1000)
    observation, reward, terminated, truncated, info = env.step(0)

Where gymnasium is installed, KickEnv is a gymnasium.Env, gymnasium.make("Striker/Kick-v0") makes one, and
gymnasium.make_vec("Striker/Kick-v0", num_envs=1024, vectorization_mode="vector_entry_point") makes a VectorKickEnv.
gymnasium.make("Striker/Match-v0") makes a TeamMatchEnv: a match (MatchEnv) whose five robots are one agent. Nothing here needs it.
"""

from striker._native import FIRST_TRAINING_EPISODE, FIRST_VALIDATION_EPISODE
from striker.kick_env import KickEnv
from striker.match_env import MatchEnv, MatchRecord
from striker.networks import Network, export
from striker.records import KickRecord
from striker.registration import register
from striker.team_match_env import TeamMatchEnv
from striker.vector_kick_env import VectorKickEnv

__all__ = ["FIRST_TRAINING_EPISODE", "FIRST_VALIDATION_EPISODE", "KickEnv", "KickRecord", "MatchEnv", "MatchRecord",
           "Network", "TeamMatchEnv", "VectorKickEnv", "export"]

register()
