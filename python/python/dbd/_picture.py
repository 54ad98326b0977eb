"""Pictures of the cart with its pendulum, for `render_mode`."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

FRAMES = 50
"""[Hz] a picture per action."""
_CART = (0.14, 0.07)  # [m] width and height.
_SIZE = (6.0, 4.0)  # [in]
_DOTS = 100  # Per inch.


class Picture:
    """A figure, redrawn for each state.

    Args:
        window: Whether it opens one.
        limits: [m, rad] where an episode ends: the cart from the middle, the pendulum from upright.
        length: [m] of the pendulum.

    Raises:
        gymnasium.error.DependencyNotInstalled: matplotlib is not installed.
    """

    def __init__(self, window: bool, limits: tuple[float, float], length: float) -> None:
        try:
            from matplotlib.backends.backend_agg import FigureCanvasAgg
            from matplotlib.figure import Figure
            from matplotlib.patches import Rectangle
        except ImportError as error:
            raise gymnasium.error.DependencyNotInstalled("pictures need matplotlib: pip install 'dbd-sim[gym]'") from error
        self._window = window
        self._pause: Any = None
        if window:
            from matplotlib import pyplot

            self._figure = pyplot.figure(figsize=_SIZE, dpi=_DOTS, num="dbd/CartPendulum-v0")
            if self._figure.canvas.required_interactive_framework is None:
                gymnasium.logger.warn("matplotlib cannot open a window: use render_mode='rgb_array' to get arrays")
            else:
                self._pause = pyplot.pause
        else:
            self._figure = Figure(figsize=_SIZE, dpi=_DOTS)
            self._canvas = FigureCanvasAgg(self._figure)
        farthest, self._steepest = limits
        self._length = length
        self._axes = self._figure.add_axes((0.0, 0.0, 1.0, 1.0))
        half = farthest + length
        self._axes.set_xlim(-half, half)
        self._axes.set_ylim(-0.4 * length, 1.35 * length)
        self._axes.set_aspect("equal")
        self._axes.axis("off")
        self._axes.plot([-half, half], [0.0, 0.0], color="0.6", linewidth=2.0, zorder=0)
        for end in (-farthest, farthest):
            self._axes.plot([end, end], [-_CART[1], _CART[1]], color="tab:red", linewidth=2.0, zorder=0)
        self._cart = self._axes.add_patch(Rectangle((0.0, -_CART[1] / 2), *_CART, facecolor="tab:blue", edgecolor="black"))
        (self._pendulum,) = self._axes.plot([], [], color="tab:orange", linewidth=6.0, solid_capstyle="round")
        self._text = self._axes.text(0.02, 0.96, "", transform=self._axes.transAxes, va="top", family="monospace")

    def draw(self, seen: NDArray[np.float32], time: float) -> None:
        """The state of an observation at a time [s]."""
        x, angle = float(seen[0]), float(seen[1])
        self._cart.set_x(x - _CART[0] / 2)
        tip = (x - self._length * np.sin(angle), self._length * np.cos(angle))
        self._pendulum.set_data([x, tip[0]], [0.0, tip[1]])
        self._pendulum.set_color("tab:orange" if abs(angle) <= self._steepest else "tab:red")
        self._text.set_text(f"{time:6.2f} s  {x:+.3f} m  {angle:+.3f} rad")
        self._figure.canvas.draw()
        if self._pause is not None:
            self._pause(1.0 / FRAMES)

    def pixels(self) -> NDArray[np.uint8]:
        """The picture, height x width x 3."""
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()

    def close(self) -> None:
        """Closes the window."""
        if self._window:
            from matplotlib import pyplot

            pyplot.close(self._figure)
