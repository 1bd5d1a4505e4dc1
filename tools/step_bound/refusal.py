# SPDX-License-Identifier: Apache-2.0
"""What the analysis does not understand: it gives no bound then, and says where it stopped."""


class Refusal(Exception):
    """No bound can be given; the text names the place."""
