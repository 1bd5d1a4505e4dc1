# SPDX-License-Identifier: Apache-2.0
"""Box, Discrete and MultiDiscrete: Gymnasium's own where it is installed, and else what of them an environment needs."""

import numpy

try:
    from gymnasium.spaces import Box, Discrete, MultiDiscrete
except ImportError:

    class Space:
        def __init__(self, shape, dtype, seed=None):
            self.shape, self.dtype = tuple(shape), numpy.dtype(dtype)
            self.seed(seed)

        def seed(self, seed=None):
            self._random = numpy.random.default_rng(seed)

        def __contains__(self, value):
            return self.contains(value)

    class Box(Space):
        """Arrays of one shape and type within bounds."""

        def __init__(self, low, high, shape, dtype=numpy.float32, seed=None):
            super().__init__(shape, dtype, seed)
            self.low, self.high = (numpy.full(shape, bound, dtype) for bound in (low, high))

        def sample(self):
            bounded = numpy.isfinite(self.low) & numpy.isfinite(self.high)
            within = self._random.uniform(numpy.where(bounded, self.low, 0), numpy.where(bounded, self.high, 1))
            return numpy.where(bounded, within, self._random.normal(size=self.shape)).astype(self.dtype)

        def contains(self, value):
            return (isinstance(value, numpy.ndarray) and value.dtype == self.dtype and value.shape == self.shape
                    and bool(numpy.all(value >= self.low) and numpy.all(value <= self.high)))

        def __eq__(self, other):
            return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                    and bool(numpy.array_equal(self.low, other.low) and numpy.array_equal(self.high, other.high)))

        def __repr__(self):
            return f"Box({self.low.min()}, {self.high.max()}, {self.shape}, {self.dtype})"

    class Discrete(Space):
        """0 to n - 1."""

        def __init__(self, n, seed=None):
            super().__init__((), numpy.int64, seed)
            self.n = int(n)

        def sample(self):
            return self._random.integers(self.n)

        def contains(self, value):
            whole = isinstance(value, (int, numpy.integer)) and not isinstance(value, bool)
            return whole and 0 <= int(value) < self.n

        def __eq__(self, other):
            return isinstance(other, Discrete) and self.n == other.n

        def __repr__(self):
            return f"Discrete({self.n})"

    class MultiDiscrete(Space):
        """Arrays of whole numbers, each 0 to its own bound - 1."""

        def __init__(self, nvec, seed=None):
            self.nvec = numpy.asarray(nvec, numpy.int64)
            super().__init__(self.nvec.shape, numpy.int64, seed)

        def sample(self):
            return self._random.integers(self.nvec)

        def contains(self, value):
            return (isinstance(value, numpy.ndarray) and value.shape == self.shape
                    and numpy.issubdtype(value.dtype, numpy.integer)
                    and bool(numpy.all(value >= 0) and numpy.all(value < self.nvec)))

        def __eq__(self, other):
            return isinstance(other, MultiDiscrete) and numpy.array_equal(self.nvec, other.nvec)

        def __repr__(self):
            return f"MultiDiscrete({self.nvec.tolist()})"


__all__ = ["Box", "Discrete", "MultiDiscrete"]
