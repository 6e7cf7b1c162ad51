from os import PathLike
from typing import Any, Callable, Literal, Mapping, Sequence, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Set = str | Sequence[str] | Mapping[str, Any] | None
_Floats = NDArray[np.float64]
_Force = Callable[[float, _Floats, _Floats, _Floats], ArrayLike]

class Error(Exception):
    kind: Literal["usage", "content", "diverged", "file", "renderer", "interrupted"]

class Diverged(Error):
    tick: int
    time: float
    body: str
    point: int
    spring: str
    safe_step: float

class _Energies(TypedDict):
    kinetic: float
    elastic: float
    gravitational: float
    total: float

class _Measures(TypedDict):
    momentum: _Floats
    angular_momentum: _Floats
    max_strain: float
    contacts: int
    penetration: float
    body_contacts: int
    crossings: int
    broken_springs: int
    volume: float
    rest_volume: float

class _Island(TypedDict):
    name: str
    bodies: list[str]
    points: int
    springs: int
    mass: float
    method: str
    step: float
    step_limit: float
    substeps: int

class _Joint(TypedDict):
    name: str
    kind: str
    a: str
    b: str
    points: int
    left: int

class Surface:
    @property
    def name(self) -> str: ...
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...

class World:
    @property
    def tick(self) -> int: ...
    @property
    def time(self) -> float: ...
    @property
    def tick_seconds(self) -> float: ...
    @property
    def ticks_per_frame(self) -> int: ...
    @property
    def hash(self) -> str: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def equal_bits(self) -> bool: ...
    @property
    def islands(self) -> list[_Island]: ...
    @property
    def joints(self) -> list[_Joint]: ...
    @property
    def methods(self) -> dict[str, str]: ...
    def positions(self, target: str) -> _Floats: ...
    def velocities(self, target: str) -> _Floats: ...
    def masses(self, target: str) -> _Floats: ...
    def energies(self, bodies: str = "") -> _Energies: ...
    def measures(self, bodies: str = "") -> _Measures: ...
    def surfaces(self) -> list[Surface]: ...
    def render(
        self,
        size: tuple[int, int] | None = None,
        *,
        camera: str = "",
        samples: Literal[1, 4, 8, 16] | None = None,
        debug: bool = False,
    ) -> NDArray[np.uint8]: ...
    def step(self, ticks: int = 1) -> None: ...
    def run(self, *, until: float) -> None: ...
    def apply(self, action: Mapping[str, Any]) -> None: ...
    def place(
        self, collider: str, position: ArrayLike | None = None, rotation_deg: ArrayLike | None = None
    ) -> None: ...
    def place_of(self, collider: str) -> tuple[_Floats, _Floats]: ...
    def add_force(
        self,
        force: _Force,
        on: str | Sequence[str] | None = None,
        *,
        energy: _Force | None = None,
        name: str = "",
        stiffness: float = 0.0,
        damping_per_s: float = 0.0,
    ) -> str: ...
    def add_system(self, system: Callable[[World, float, float], object]) -> None: ...
    def save(self) -> bytes: ...
    def restore(self, state: bytes) -> None: ...

def load(path: str | bytes | PathLike[str] | PathLike[bytes], set: _Set = None, *, threads: int = 0, confined: bool = False) -> World: ...
def loads(text: str, set: _Set = None, *, threads: int = 0, name: str = "scene.toml") -> World: ...
def methods() -> list[str]: ...
