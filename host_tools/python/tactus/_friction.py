"""Friction models by themselves."""

from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _core
from ._arrays import Numbers, Table, above_zero, numbers, table, times


class Friction:
    """A friction model with its parameters, as `tactus friction` runs it.

    The parameters have the names of the papers, such as sigma0, Fc and Fs, and those of table I of the
    LuGre paper where they are not given. With `normal_force_N` the levels and the viscous terms are per
    newton of it, as on a surface; without it they are forces, as in a joint. The force points along the
    motion: a mass feels its negative.
    """

    def __init__(
        self, model: str = "lugre", *, normal_force_N: Optional[float] = None, **parameters: float
    ) -> None:
        """Raises Error, with the names that there are, for a model or parameter that is not known."""
        self._force_N = None if normal_force_N is None else above_zero("normal_force_N", normal_force_N)
        self._model = _core.FrictionModel(model, _assignments(parameters), self._force_N)
        self.model = model

    @property
    def parameters(self) -> Dict[str, float]:
        """All parameters of the model, in the order of `tactus friction --help`."""
        return self._model.parameters()

    def motion(self, t_s: Any, x_m: Any) -> Table:
        """Returns the friction along a motion, one row a time: t_s, x_m, v_m_per_s, force_N, bristle_m.

        The motion is at rest in the first row; the velocity is the difference to the row before.
        """
        return table(self._model.motion(*_course(t_s, "x_m", x_m)))

    def push(self, t_s: Any, force_N: Any, *, mass_kg: float = 1.0, rate_hz: float = 1000.0) -> Table:
        """Returns the motion of a mass at rest that is pushed, one row a tick, with the column push_N too.

        The push is straight between its times.
        """
        course = _course(t_s, "force_N", force_N)
        return table(self._model.push(*course, above_zero("mass_kg", mass_kg), above_zero("rate_hz", rate_hz)))

    def experiment(
        self,
        name: str,
        *,
        mass_kg: float = 1.0,
        rate_hz: float = 1000.0,
        **setup: Union[float, Tuple[float, ...]],
    ) -> Tuple[Table, Optional[Table]]:
        """Runs a published experiment: presliding, lag, break-away, stick-slip, hunting or hysteresis.

        Returns its course and what was measured in it, or None where an experiment measures nothing. A
        value that does not exist is NaN. `setup` changes the published set-up; a sequence is a list.
        """
        track, findings = self._model.experiment(
            name, _assignments(setup), above_zero("mass_kg", mass_kg), above_zero("rate_hz", rate_hz)
        )
        return table(track), table(findings) if findings else None

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:g}" for name, value in self.parameters.items())
        return f"<tactus.Friction {self.model}: {values}>"


def _assignments(values: Dict[str, Any]) -> List[str]:
    """Returns texts such as "Fc=0.3", with all bits of the numbers."""
    found = []
    for name, value in values.items():
        several = np.atleast_1d(numbers(name, value, ("N",) if np.ndim(value) else ()))
        found.append(f"{name}=" + ",".join(repr(float(each)) for each in several))
    return found


def _course(t_s: Any, name: str, values: Any) -> Tuple[Numbers, Numbers]:
    """Returns two or more times and as many values."""
    moments = times("t_s", t_s)
    course = numbers(name, values, ("N",))
    if len(moments) < 2 or len(course) != len(moments):
        raise ValueError(f"t_s has {len(moments)} times and {name} {len(course)} values; give two or more of each")
    return moments, course
