"""Bakes mesh files and says of each what came of it. See real_meshes.sh.

    real_meshes.py TACTUS FILE...      one line a file: verdict, file, the oracle's figures, triangles, messages

| verdict | |
|---|---|
| right | every triangle that the file declares is in the image, or was dropped as one without area |
| told | some are not, or the mesh is closed and inside out, and a message says so |
| refused | baking failed with a message |
| uncounted | baked, but the oracle cannot read the file |
| SILENT | the image differs from the file, and no message says so |
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import count_mesh

# Volumes closer to 0, in cubes over the longest side, may be rounding errors.
LEAST_VOLUME = 1e-7


def bake(tactus, file, folder):
    """Returns the triangles of the image with those dropped, or None, and the messages."""
    scene = os.path.join(folder, "scene.toml")
    with open(scene, "w", encoding="utf-8") as stream:
        stream.write(f'[[object]]\nmesh = "{os.path.abspath(file)}"\nlongest_side_m = 0.2\n')
    run = subprocess.run([tactus, "bake", scene, "--json"], capture_output=True, text=True, timeout=600, check=False,
                         errors="replace")
    if run.returncode != 0:
        return None, run.stderr
    report = json.loads(run.stdout)["objects"][0]
    return report["triangles"] + report["dropped_triangles"], run.stderr


def verdict(oracle, imported, messages):
    if imported is None:
        return "refused" if messages.startswith("tactus bake: ") else "SILENT"
    if oracle is None:
        return "uncounted"
    triangles, closed, volume, side = oracle
    found = set()
    if imported != triangles:
        found.add("told" if re.search("left out|declares", messages) else "SILENT")
    if closed == "closed" and volume < -LEAST_VOLUME * side**3:
        found.add("told" if "inside out" in messages else "SILENT")
    return "SILENT" if "SILENT" in found else "told" if found else "right"


def main():
    tactus, files = os.path.abspath(sys.argv[1]), sys.argv[2:]
    silent = 0
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            try:
                oracle = count_mesh.count(file)
            except count_mesh.Unread:
                oracle = None
            imported, messages = bake(tactus, file, folder)
            word = verdict(oracle, imported, messages)
            silent += word == "SILENT"
            figures = " ".join(str(figure) for figure in oracle or ["unread"])
            print(word, file, figures, imported, " ".join(messages.split()), sep="\t", flush=True)
    sys.exit(1 if silent else 0)


main()
