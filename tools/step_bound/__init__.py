# SPDX-License-Identifier: Apache-2.0
"""A proved bound on what one call of a function in a linked Arm image takes. See README.md."""
