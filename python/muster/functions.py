"""Functions of Python as instances of a world: controllers, radio terms, or any phase of a tick."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Sequence, Union

from . import _muster

#: A table such as "robot/rover/odometry", or a pair with its columns, such as ("self/sum", "x[m]").
Claim = Union[str, "tuple[str, str]"]
Claims = Union[Claim, Sequence[Claim]]


def _list_of(claims: Claims) -> list[tuple[str, str]]:
    if isinstance(claims, str):
        return [(claims, "")]
    if isinstance(claims, tuple) and len(claims) == 2 and all(isinstance(c, str) for c in claims) and "/" not in claims[1]:
        return [claims]
    return [(claim, "") if isinstance(claim, str) else claim for claim in claims]


@dataclass(frozen=True)
class Function:
    """A function that runs as an instance of a world.

    It is called in each tick as `code(tick, *arrays)`, with a `Tick` and one array of float64 for each table of `read` and
    `modify`, in this order: [rows x columns], or [columns] where the claim names one row. The arrays are its own copies.
    It returns an array of the same form for each table of `write`, `add` and `modify` in this order; a tuple where these are
    several, None where there are none or only queues, to which it appends by `tick.send`. NaN is an empty cell.

    Values that outlive a tick belong in a table of its own, `write=("self/sum", "x[m]")`, read by `tick.last("self/sum")`:
    what it keeps elsewhere is unknown to snapshots. An exception ends the tick, which is taken back, as an `Error` whose
    `__cause__` it is.

    phase: control, actuate, physics, radio, network, sense or observe. A function of the phase control sees what robots
    sense and nothing else, as a plugin does; `robot` binds it to one. every: ticks from one call to the next.
    """

    code: Callable[..., Any]
    phase: str
    read: Claims = ()
    write: Claims = ()
    add: Claims = ()
    modify: Claims = ()
    robot: str = ""
    every: int = 1
    name: str = ""

    def __post_init__(self) -> None:
        if not callable(self.code):
            raise _muster.Error(f"a function of muster cannot be {self.code!r}; expected something that can be called")
        if not isinstance(self.every, int) or self.every < 1:
            raise _muster.Error(f"every: {self.every!r} is no number of ticks; expected an integer from 1")

    def _named(self) -> _muster.NamedCode:
        name = self.name or getattr(self.code, "__name__", "function").strip("<>")
        claims = []
        for kind in ("read", "modify"):  # the order of the arguments, which is that of the claims
            claims += [(kind, *claim) for claim in _list_of(getattr(self, kind))]
        rest = [(kind, *claim) for kind in ("write", "add") for claim in _list_of(getattr(self, kind))]
        claims = [c for c in claims if c[0] == "read"] + rest + [c for c in claims if c[0] == "modify"]
        claims = [(kind, table.replace("{robot}", self.robot), columns) for kind, table, columns in claims]
        where = getattr(self.code, "__code__", None)
        file, line = (where.co_filename, where.co_firstlineno) if where else ("python", 0)
        return _muster.NamedCode(name, self.robot, self.every, file, line, _muster.Code(self.code, self.phase, claims, name))


def controller(
    code: Callable[..., Any] | None = None,
    *,
    robot: str,
    read: Claims = (),
    write: Claims = "robot/{robot}/command",
    every: int = 1,
    name: str = "",
) -> Any:
    """A function that steers a robot: `code(tick, *read)` returns the command, [v in m/s, w in rad/s] by default.

    A word without a slash in `read` or `write`, such as "odometry", is a quantity of the robot. The function knows what the
    robot senses: claims on truth, such as its pose, are an Error when the world is loaded. Without `code` it decorates:

        @muster.controller(robot="rover", read="odometry")
        def steer(tick, odometry): return [0.3, -odometry[2]]
    """

    def own(claims: Claims) -> list[tuple[str, str]]:
        return [(t if "/" in t else f"robot/{robot}/{t}", columns) for t, columns in _list_of(claims)]

    def made(code: Callable[..., Any]) -> Function:
        return Function(code, "control", read=own(read), write=own(write), robot=robot, every=every, name=name)

    return made if code is None else made(code)


def radio_term(
    code: Callable[..., Any] | None = None,
    *,
    read: Claims = ("endpoint/*/pose", "link/*/ends"),
    name: str = "",
) -> Any:
    """A function that adds to the level of each link: `code(tick, poses, ends)` returns dB, one a link.

    poses: [endpoints x 7], x y z in m and a quaternion; ends: [links x 2], the numbers of both endpoints, sender first. In a
    fit, and where `tick.expected`, it is to give the mean of what it draws. Without `code` it decorates.
    """

    def made(code: Callable[..., Any]) -> Function:
        return Function(code, "radio", read=read, add="link/*/level", name=name)

    return made if code is None else made(code)
