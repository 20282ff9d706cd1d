"""A running controller: tactusd, `tactus sim --serve`, or a bare board."""

import os
import threading
import time
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, Union

from . import _core
from ._arrays import PathLike, above_zero, numbers, path_text, texts

Value = Union[float, str]


class Refused(_core.Error):
    """The controller refused a command; the message says why and what to do."""


Refused.__module__ = "tactus"


class Ticks(Iterator[Dict[str, Any]]):
    """The ticks of a running controller, one dictionary each, until it ends.

    A reader that is too slow misses ticks: a gap shows in the numbers of the field `tick`. Threads may
    share it; each tick goes to one of them. Use it in a `with` block, or close it.
    """

    def __init__(self, ticks: "_core.LiveTicks", timeout_s: float) -> None:
        self._ticks: Optional[_core.LiveTicks] = ticks
        self._timeout_s = timeout_s
        self._lock = threading.Lock()

    def __iter__(self) -> "Ticks":
        return self

    def __next__(self) -> Dict[str, Any]:
        """Waits for the next tick; other threads run meanwhile, and Ctrl-C is heard.

        Raises TimeoutError if none has come in `timeout_s`.
        """
        ticks = self._ticks
        if ticks is None:
            raise StopIteration
        with self._lock:
            tick = ticks.next(self._timeout_s)
        if tick is not None:
            return tick
        if ticks.ended:
            raise StopIteration
        raise TimeoutError(f"the controller has sent no tick for {self._timeout_s} s")

    def close(self) -> None:
        """Ends the connection."""
        self._ticks = None

    def __enter__(self) -> "Ticks":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Controller:
    """A device of a running controller. Use it in a `with` block, or close it: the controller goes on."""

    def __init__(self, place: "_core.ControllerPlace") -> None:
        self._place: Optional[_core.ControllerPlace] = place

    def get(self, name: Optional[str] = None) -> Union[Value, Dict[str, Value]]:
        """Returns a parameter, or all of them by their names, as `tactus get` does.

        A number is in the unit of its name; a contact method or a friction model is a word.
        """
        if name is None:
            _, lines = self._ask("list", patience_s=60.0)
            return dict(_named_value(line.split()[1]) for line in lines)
        return _reply_value(self._ask(f"get {_word('name', name)}")[0])

    def set(self, name: str, value: Value) -> Value:
        """Changes a parameter from the next tick on, and returns its new value. Raises Refused."""
        text = value if isinstance(value, str) else repr(float(value))
        return _reply_value(self._ask(f"set {_word('name', name)} {_word('value', text)}")[0])

    def status(self) -> Dict[str, str]:
        """Returns tick, mode, faults and scene, in the words of `tactus status`."""
        words, _ = self._ask("status")
        head, _, scene = words.partition(" scene=")
        found = dict(word.split("=", 1) for word in head.split() if "=" in word)
        return {**found, "scene": scene}

    def home(self, *, wait: bool = True, timeout_s: float = 60.0) -> None:
        """Lets the device find its reference; with `wait` returns when it has. Raises Refused if it fails."""
        self._ask("home")
        end_s = time.monotonic() + above_zero("timeout_s", timeout_s)
        while wait:
            status = self.status()
            if status["mode"] == "ready":
                return
            if status["mode"] != "homing":
                raise Refused("the device has not found its reference: " + _words(status))
            if time.monotonic() > end_s:
                raise TimeoutError(f"the device has not found its reference in {timeout_s} s")
            time.sleep(0.02)

    def enable(self) -> None:
        """Lets the controller put force on the hand, rising softly; from the mode `ready`."""
        self._ask("enable")

    def disable(self) -> None:
        """Takes the force away; the mode is then `ready`."""
        self._ask("disable")

    def reset(self) -> None:
        """Leaves the mode `fault`, once its cause is gone."""
        self._ask("reset")

    def estop(self) -> None:
        """Stops at once: no force, brakes, mode `fault`. It has a socket of its own.

        It does not replace an emergency stop that cuts the power.
        """
        ok, text, _ = self._open_place().stop()
        if not ok:
            raise Refused(text)

    def watch(self, fields: Union[str, Sequence[str]] = (), *, every: int = 1, timeout_s: float = 5.0) -> Ticks:
        """Returns the ticks as they come, with the names of `tactus watch --list` and `tactus export`.

        `fields` are names of columns or their beginnings; without any, a tick has all. `every` passes
        ticks over. The iterator raises TimeoutError if no tick comes in `timeout_s`.
        """
        if every < 1:
            raise ValueError(f"every is {every}; it has to be 1 or more")
        above_zero("timeout_s", timeout_s)
        return Ticks(self._open_place().ticks(texts("fields", fields), every), timeout_s)

    def close(self) -> None:
        """Ends the connection, and the line to a board. Raises Unreachable if that was lost meanwhile."""
        place, self._place = self._place, None
        if place is not None:
            place.close()

    def __enter__(self) -> "Controller":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _open_place(self) -> "_core.ControllerPlace":
        if self._place is None:
            raise ValueError("the connection is closed")
        return self._place

    def _ask(self, line: str, patience_s: float = 5.0) -> Tuple[str, List[str]]:
        """Sends a line, and returns the reply without its first word, and the lines before it."""
        ok, text, lines = self._open_place().send(line, patience_s)
        if not ok:
            raise Refused(text)
        return text.partition(" ")[2], lines


def connect(
    run_dir: Optional[PathLike] = None,
    device: Union[int, str] = 1,
    serial: Optional[str] = None,
    *,
    timeout_s: float = 0.0,
) -> Controller:
    """Reaches a running controller, as the verbs of `tactus` do.

    `run_dir` is the folder of its sockets; without it that of TACTUS_RUN_DIR, or /run/tactus. `device` is
    a device's name or its number, 1 for the first. `serial` is the line of a bare board in place of a
    folder: "/dev/ttyACM0", or "unix:PATH" of an emulator. Raises Unreachable, with the remedy, if nobody
    answers there in `timeout_s`: more than 0 waits for a controller that is about to start.
    """
    end_s = time.monotonic() + float(numbers("timeout_s", timeout_s, ()))
    folder = os.environ.get("TACTUS_RUN_DIR", _core.DEFAULT_RUN_DIR) if run_dir is None else run_dir
    while True:
        try:
            return _reach(path_text("run_dir", folder), str(device), serial or "")
        except _core.Unreachable:
            if time.monotonic() >= end_s:
                raise
        time.sleep(0.02)


def _reach(run_dir: str, device: str, serial: str) -> Controller:
    """Returns the controller once it has answered."""
    controller = Controller(_core.ControllerPlace(run_dir, device, serial))
    try:
        controller._ask("status")
    except _core.Error:
        controller.close()
        raise
    return controller


def _words(fields: Dict[str, str]) -> str:
    """Returns fields as the controller writes them."""
    return " ".join(f"{name}={text}" for name, text in fields.items())


def _word(name: str, text: str) -> str:
    """Returns a word of a command line; a blank or the end of a line would begin another."""
    if not isinstance(text, str) or not text or text.split() != [text]:
        raise ValueError(f"{name} {text!r} has to be one word")
    return text


def _named_value(word: str) -> Tuple[str, Value]:
    """Returns the name and the value of a word like max_force_N=8."""
    name, _, text = word.partition("=")
    try:
        return name, float(text)
    except ValueError:
        return name, text


def _reply_value(words: str) -> Value:
    """Returns the value of a reply like `get tick=40 max_force_N=8 least=0 greatest=8 unit=N`."""
    return _named_value(words.split()[2])[1]
