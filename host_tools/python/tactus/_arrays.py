"""Checks of arguments, and arrays with named columns."""

import os
from typing import Any, Dict, List, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

PathLike = Union[str, "os.PathLike[str]"]
Numbers = npt.NDArray[np.float64]
Table = npt.NDArray[np.void]


def path_text(name: str, path: PathLike) -> str:
    """Returns a path as text; `name` is the argument's, for messages."""
    try:
        text = os.fspath(path)
    except TypeError:
        raise TypeError(f"{name} has to be a path, not {type(path).__name__}") from None
    if not isinstance(text, str):
        raise TypeError(f"{name} has to be a path of text, not of bytes")
    if "\0" in text:
        raise ValueError(f"{name} {text!r} has a zero in it, which no file's name has")
    return text


def numbers(name: str, value: Any, shape: Tuple[Union[int, str], ...]) -> Numbers:
    """Returns the value as an array of float64. A word in the shape stands for any length above 0.

    Raises TypeError if it holds no real numbers, ValueError if its shape is another, or if a number is
    not finite.
    """
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} has to hold real numbers, not {array.dtype}")
    wanted = "(" + ", ".join(str(length) for length in shape) + ("," if len(shape) == 1 else "") + ")"
    if array.ndim != len(shape) or any(
        length == 0 if isinstance(want, str) else length != want for length, want in zip(array.shape, shape)
    ):
        raise ValueError(f"{name} has to have the shape {wanted}, not {array.shape}")
    array = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{name}{list(place)} is {array[place]}; it has to be finite")
    return array


def times(name: str, value: Any) -> Numbers:
    """Returns times that grow from one to the next, s; raises ValueError if they do not."""
    array = numbers(name, value, ("N",))
    late = np.flatnonzero(np.diff(array) <= 0)
    if late.size:
        i = int(late[0]) + 1
        raise ValueError(f"{name}[{i}] is {array[i]}, which does not come after {array[i - 1]}")
    return array


def above_zero(name: str, value: Any) -> float:
    """Returns a number that is finite and above 0; raises TypeError or ValueError otherwise."""
    number = float(numbers(name, value, ()))
    if number <= 0:
        raise ValueError(f"{name} is {number}; it has to be above 0")
    return number


def texts(name: str, value: Union[str, Sequence[str]]) -> List[str]:
    """Returns one text, or several, as a list."""
    found = [value] if isinstance(value, str) else list(value)
    for each in found:
        if not isinstance(each, str):
            raise TypeError(f"{name} has to be text, not {type(each).__name__}")
    return found


def table(columns: Dict[str, npt.NDArray[Any]]) -> Table:
    """Returns columns as one array with a field for each; the dictionary is empty afterwards."""
    dtype = np.dtype([(name, column.dtype) for name, column in columns.items()], align=True)
    rows = np.empty(len(next(iter(columns.values()))), dtype)
    for name in list(columns):
        rows[name] = columns.pop(name)
    return rows
