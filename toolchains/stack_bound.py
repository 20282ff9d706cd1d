#!/usr/bin/env python3
"""Bounds the stack of a bare-metal program for Arm Thumb from its call graph.

The call graph and the frames are read from the linked program, not from the compiler's notes (-fstack-usage), which know nothing of the
libraries and of what the linker chose. Two things are not in the instructions and are told by a file (--calls): which functions a call
through a pointer may reach, and how deep a recursion can be. The program is refused where the file is silent, where it names a function
that does not exist, and where the address of a function is taken that no call is said to reach."""

import argparse
import bisect
import collections
import dataclasses
import fnmatch
import re
import subprocess
import sys

EXAMPLES = """examples:
  toolchains/stack_bound.py build/cortex-m7/bin/mps2_an500 --calls firmware/mps2_an500/stack_calls.txt
  toolchains/stack_bound.py program.elf --calls calls.txt --entry main --entry tick_handler

A line of the file of calls has one of these forms; * stands for any text, and the text after # is a remark:
  CALLER -> CALLEE | CALLEE        the calls through pointers in CALLER reach these functions; `nothing` if they are never made
  recursion FUNCTION DEPTH         FUNCTION calls itself, and is at most DEPTH times on the stack

Ends with 0 and a bound for each entry, with 1 if the stack has no bound that is known, and with 2 for bad input."""

# Functions begin on even addresses; a pointer to Thumb code has its lowest bit set.
THUMB = 1
CONDITIONS = "eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le"


class Unbounded(Exception):
    """There is no bound of the stack that is known."""


@dataclasses.dataclass
class Instruction:
    address: int
    raw: bytes
    name: str  # without .w and .n
    operands: str

    def is_data(self):
        return self.name.startswith(".")

    def target(self):
        """Returns the address that a direct branch goes to."""
        return int(re.match(r"(?:\w+, )?([0-9a-f]+) <", self.operands).group(1), 16)


@dataclasses.dataclass
class Function:
    names: list  # as the linker knows it
    title: str  # as a reader knows it
    body: list
    frame: int = 0  # the most bytes that it has on the stack itself
    calls: set = dataclasses.field(default_factory=set)
    tail_calls: dict = dataclasses.field(default_factory=dict)  # jumps out of it, with the bytes on the stack then
    calls_pointers: bool = False


def refuse(trouble):
    print(f"stack_bound: {trouble}", file=sys.stderr)
    sys.exit(2)


def run(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except FileNotFoundError:
        refuse(f"there is no {command[0]}: toolchains/install-packages.sh cortex-m7")
    except subprocess.CalledProcessError as failure:
        refuse(failure.stderr.strip())


def read_symbols(program, tools):
    """Returns the names of every address, and the address of every name."""
    names, addresses = collections.defaultdict(list), {}
    for line in run(tools + "nm", program).splitlines():
        fields = line.split()
        if len(fields) == 3:
            addresses[fields[2]] = int(fields[0], 16)
            if fields[1] in "tTwW":
                names[int(fields[0], 16) & ~THUMB].append(fields[2])
    return names, addresses


def read_functions(program, tools, names):
    """Returns the functions of the program by their addresses."""
    functions, body = {}, None
    for line in run(tools + "objdump", "-d", "-j", ".text", program).splitlines():
        if head := re.match(r"([0-9a-f]+) <(.+)>:$", line):
            address = int(head.group(1), 16)
            body = []
            functions[address] = Function(names.get(address, [head.group(2)]), "", body)
        elif code := re.match(r"\s+([0-9a-f]+):\t((?:[0-9a-f]+ )+)\s*\t(\S+)(?:\t(.*))?$", line):
            words = code.group(2).split()
            raw = b"".join(int(word, 16).to_bytes(len(word) // 2, "little") for word in words)
            name = re.sub(r"\.[wn]$", "", code.group(3))
            body.append(Instruction(int(code.group(1), 16), raw, name, re.split("[@;]", code.group(4) or "")[0].strip()))
    titles = subprocess.run([tools + "c++filt"], input="\n".join(f.names[0] for f in functions.values()), capture_output=True, text=True,
                            check=True).stdout.splitlines()
    for function, title in zip(functions.values(), titles):
        function.title = title
    return functions


def count_registers(operands):
    """Returns the number of registers in {r4, r6-r8}."""
    count = 0
    for part in re.search(r"\{(.*)\}", operands).group(1).split(","):
        ends = [int(digits) for digits in re.findall(r"[rds](\d+)", part)]
        count += ends[1] - ends[0] + 1 if len(ends) == 2 else 1
    return count


def growth(step):
    """Returns the bytes by which an instruction lets the stack grow; negative where it shrinks."""
    name, operands = step.name, step.operands
    if name in ("push", "pop") or (name in ("stmdb", "ldmia") and operands.startswith("sp!")):
        return (4 if name in ("push", "stmdb") else -4) * count_registers(operands)
    if name in ("vpush", "vpop"):
        return (1 if name == "vpush" else -1) * (8 if "{d" in operands else 4) * count_registers(operands)
    if constant := re.match(r"sp, (?:sp, )?#(\d+)$", operands):
        if name in ("sub", "subw", "add", "addw"):
            return (1 if name.startswith("sub") else -1) * int(constant.group(1))
    if before := re.search(r"\[sp, #(-?\d+)\]!", operands):
        return -int(before.group(1))
    if after := re.search(r"\[sp\], #(-?\d+)", operands):
        return -int(after.group(1))
    if re.match(r"sp\b", operands) and not re.match("(v?stm|v?ldm|str|cmp|push)", name):
        raise Unbounded(f"{step.address:x}: {name} {operands}: the stack grows by an amount that is not constant")
    return 0


def table_targets(body, place):
    """Returns the addresses that the table behind a tbb or tbh leads to."""
    data = b""
    for step in body[place + 1:]:
        if not step.is_data():
            break
        data += step.raw
    width = 1 if body[place].name == "tbb" else 2
    entries = [int.from_bytes(data[i:i + width], "little") for i in range(0, len(data) - width + 1, width)]
    return [body[place].address + 4 + 2 * entry for entry in entries]


def follow(function, places, place, depth):
    """Notes the calls of an instruction, and returns the addresses that may follow in the function."""
    body = function.body
    step = body[place]
    name, operands = step.name, step.operands
    following = [body[place + 1].address] if place + 1 < len(body) else []
    if name == "bl":
        function.calls.add(step.target())
        return following
    if name == "blx":
        function.calls_pointers = True
        return following
    if name in ("cbz", "cbnz") or re.fullmatch(f"b({CONDITIONS})?", name):
        target = step.target()
        inside = target in places
        if not inside:
            function.tail_calls[target] = max(depth, function.tail_calls.get(target, 0))
        return ([target] if inside else []) + ([] if name == "b" else following)
    if name in ("tbb", "tbh"):
        return table_targets(body, place)
    if re.fullmatch(f"bx({CONDITIONS})?", name):
        function.calls_pointers |= operands != "lr"
        return [] if name == "bx" else following
    if re.search(r"\bpc\b", operands) and re.match("(pop|ldmia|ldr|mov|add)", name) and not re.search(r"\[pc", operands):
        is_return = re.match("(pop|ldmia)", name) or (name.startswith("ldr") and "[sp]" in operands)
        if not is_return and re.match(r"pc\b", operands):
            raise Unbounded(f"{step.address:x}: {name} {operands}: this jump is not understood")
        if is_return:
            return following if re.fullmatch(f"(pop|ldmia|ldr)({CONDITIONS})", name) else []
    return following


def measure(function):
    """Finds the frame and the calls of a function: the stack at each instruction, along every path."""
    body = function.body
    places = {step.address: place for place, step in enumerate(body)}
    depths, waiting = {}, [(body[0].address, 0)] if body else []
    while waiting:
        address, depth = waiting.pop()
        place = places.get(address)
        if place is None or body[place].is_data() or depths.get(address, -1) >= depth:
            continue
        depths[address] = depth
        after = depth + growth(body[place])
        if after > 1 << 20:
            raise Unbounded(f"{function.title}: the stack grows in a loop")
        function.frame = max(function.frame, after)
        waiting += [(target, after) for target in follow(function, places, place, after)]


def taken_addresses(program, tools, functions):
    """Returns the functions whose addresses stand in data, in pools of constants or in pairs of movw and movt."""
    taken = set()

    def note(word):
        if word & THUMB and word & ~THUMB in functions:
            taken.add(word & ~THUMB)

    headers = run(tools + "objdump", "-h", program)
    for section in (".rodata", ".data", ".init_array"):
        if f" {section} " not in headers:
            continue
        for line in run(tools + "objdump", "-s", "-j", section, program).splitlines():
            if row := re.match(r" [0-9a-f]+ ((?:[0-9a-f]{2,8} ){1,4})", line):
                data = bytes.fromhex(row.group(1))
                for i in range(0, len(data) - 3, 4):
                    note(int.from_bytes(data[i:i + 4], "little"))
    for function in functions.values():
        low = {}
        for step in function.body:
            if step.name == ".word":
                note(int.from_bytes(step.raw, "little"))
            elif half := re.match(r"(\w+), #(\d+)", step.operands):
                if step.name == "movw":
                    low[half.group(1)] = int(half.group(2))
                elif step.name == "movt":
                    note(int(half.group(2)) << 16 | low.get(half.group(1), 0))
    return taken


def read_calls(path):
    """Returns callers' patterns with their callees' patterns, and patterns of recursive functions with their depths."""
    pointers, recursions = [], []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.split("#")[0].strip()
            if recursion := re.fullmatch(r"recursion (.+) (\d+)", line):
                recursions.append((recursion.group(1), int(recursion.group(2))))
            elif " -> " in line:
                caller, callees = line.split(" -> ", 1)
                pointers.append((caller.strip(), [callee.strip() for callee in callees.split(" | ")]))
            elif line:
                refuse(f"{path}:{number}: neither `CALLER -> CALLEE` nor `recursion FUNCTION DEPTH`: {line}")
    return pointers, recursions


def matches(title, pattern):
    return fnmatch.fnmatchcase(title, pattern.replace("[", "[[]"))


def join_pointers(functions, pointers, taken):
    """Adds the calls through pointers, and refuses what the file of calls leaves open."""
    troubles, called = [], set()
    for caller, callees in pointers:
        places = [f for f in functions.values() if f.calls_pointers and matches(f.title, caller)]
        if not places:
            troubles.append(f"no function that calls through a pointer is named {caller}")
        for callee in callees:
            found = {address for address, f in functions.items() if matches(f.title, callee)}
            if not found and callee != "nothing":
                troubles.append(f"{caller} -> {callee}: there is no such function")
            called |= found
            for function in places:
                function.calls |= found & taken
    for function in functions.values():
        if function.calls_pointers and not any(matches(function.title, caller) for caller, _ in pointers):
            troubles.append(f"not said what is called through a pointer in {function.title}")
    for address in sorted(taken - called):
        troubles.append(f"not said who calls {functions[address].title}, whose address is taken")
    if troubles:
        raise Unbounded("\n".join(troubles))


class Bound:
    """The most bytes of stack below each function, and the path there."""

    def __init__(self, functions, recursions):
        for pattern, _ in recursions:
            if not any(address in f.calls and matches(f.title, pattern) for address, f in functions.items()):
                raise Unbounded(f"no function that calls itself is named {pattern}")
        self.functions = functions
        self.recursions = recursions
        self.begins = sorted(functions)
        self.known = {}  # address -> (bytes, the callee that needs the most)
        self.path = []

    def containing(self, address):
        """Returns the function that an address lies in: libraries jump into each other's middle."""
        return self.begins[bisect.bisect_right(self.begins, address) - 1]

    def below(self, address):
        """Returns the bytes that the function and all that it calls need."""
        if address in self.known:
            return self.known[address][0]
        function = self.functions.get(address)
        if function is None:
            raise Unbounded(f"{address:x} is called, and is no function")
        if address in self.path:
            cycle = [self.functions[other].title for other in self.path[self.path.index(address):]]
            raise Unbounded("these call each other, to no depth that is known:\n  " + "\n  ".join(cycle))
        self.path.append(address)
        itself = address in function.calls
        depth = next((depth for pattern, depth in self.recursions if matches(function.title, pattern)), None)
        if itself and depth is None:
            raise Unbounded(f"{function.title} calls itself, to no depth that is known")
        frames = function.frame * (depth if itself else 1)
        best, deepest = frames, None
        for callee in sorted(function.calls - {address}):
            if frames + self.below(callee) > best:
                best, deepest = frames + self.below(callee), callee
        for target, depth in sorted(function.tail_calls.items()):
            callee = self.containing(target)
            if callee != address and depth + self.below(callee) > best:
                best, deepest = depth + self.below(callee), callee
        self.path.pop()
        self.known[address] = (best, deepest)
        return best

    def chain(self, address):
        """Returns the lines of the deepest chain of calls from a function on."""
        lines = []
        while address is not None:
            function = self.functions[address]
            lines.append(f"{self.known[address][0]:8} {function.frame:8}  {function.title[:150]}")
            address = self.known[address][1]
        return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0], epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the linked program (ELF, with symbols)")
    parser.add_argument("--calls", required=True, help="file: what calls through pointers reach, and depths of recursions")
    parser.add_argument("--entry", action="append", help="a function that begins with an empty stack; default: start_program")
    parser.add_argument("--tools", default="arm-none-eabi-", help="prefix of nm, objdump and c++filt; default: arm-none-eabi-")
    arguments = parser.parse_args()

    names, addresses = read_symbols(arguments.program, arguments.tools)
    functions = read_functions(arguments.program, arguments.tools, names)
    entries = arguments.entry or ["start_program"]
    for name in entries:
        if addresses.get(name, 0) & ~THUMB not in functions:
            refuse(f"{arguments.program} has no function {name}: give --entry NAME")
    try:
        pointers, recursions = read_calls(arguments.calls)
    except OSError as failure:
        refuse(f"{arguments.calls}: {failure.strerror}")
    try:
        for function in functions.values():
            measure(function)
        join_pointers(functions, pointers, taken_addresses(arguments.program, arguments.tools, functions))
        bound = Bound(functions, recursions)
        for name in entries:
            entry = addresses[name] & ~THUMB
            bound.below(entry)
            print(" in all      own  function", *bound.chain(entry), f"stack_bound_bytes {name} {bound.below(entry)}", sep="\n")
    except Unbounded as trouble:
        print(f"stack_bound: {arguments.program}:\n{trouble}", file=sys.stderr)
        sys.exit(1)


main()
