# SPDX-License-Identifier: Apache-2.0
"""The environments under their names, where gymnasium is installed."""


def register():
    try:
        import gymnasium
    except ImportError:
        return
    if "Striker/Match-v0" not in gymnasium.registry:
        gymnasium.register("Striker/Match-v0", entry_point="striker.team_match_env:TeamMatchEnv")
    if "Striker/Kick-v0" not in gymnasium.registry:
        gymnasium.register("Striker/Kick-v0", entry_point="striker.kick_env:KickEnv",
                           vector_entry_point="striker.vector_kick_env:VectorKickEnv")
