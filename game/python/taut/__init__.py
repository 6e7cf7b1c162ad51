"""taut: a mass-spring engine for ropes, cloth, blocks and nets.

    import taut
    w = taut.load("flag")                 # a shipped scene, or the path of one
    w.run(until=2.0)                      # seconds of its time
    x = w.positions("cloth.flag")         # (n, 3) float64 [m]
    picture = w.render((640, 360))        # (360, 640, 3) uint8

SI units throughout; y is up. What goes wrong raises taut.Error, with what to do about it.
"""
from ._taut import Diverged, Error, Surface, World, __version__, load, loads, methods

__all__ = ["Diverged", "Error", "Surface", "World", "load", "loads", "methods"]
