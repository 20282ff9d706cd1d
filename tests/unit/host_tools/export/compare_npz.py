"""Compares an NPZ file of `tactus export` with the CSV file of the same ticks: every number to the bit.

usage: compare_npz.py TABLE.npz TABLE.csv
Exits with 1 and the first difference if they differ.
"""
import csv
import sys

import numpy


def same(column, value, text):
    if column == "state_hash":
        return int(value) == int(text, 16)
    if value.dtype.kind == "U":
        return str(value) == text
    if value.dtype.kind in "iu":
        return int(value) == int(text)
    number = numpy.float64(text)
    return (numpy.isnan(value) and numpy.isnan(number)) or value.tobytes() == number.tobytes()


arrays = numpy.load(sys.argv[1])
with open(sys.argv[2], newline="") as file:
    rows = list(csv.reader(file))
names = rows.pop(0)
if arrays.files != names:
    sys.exit(f"arrays {arrays.files} for the columns {names}")
for place, name in enumerate(names):
    array = arrays[name]
    if array.shape != (len(rows),):
        sys.exit(f"{name}: {array.shape} for {len(rows)} ticks")
    for tick, row in enumerate(rows):
        if not same(name, array[tick], row[place]):
            sys.exit(f"{name}, row {tick}: {array[tick]} for {row[place]}")
print(f"{len(names)} arrays of {len(rows)}")
