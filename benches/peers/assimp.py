"""`sinew info` beside `assimp info`, whole processes: milliseconds on the clock and of the processor, medians over pairs.

    python3 assimp.py SINEW [FILE…]

Without files: the shared models above a megabyte where they are there, else the shipped clips.
"""

import os
import pathlib
import resource
import statistics
import subprocess
import sys
import time

PAIRS = 15


def run(command):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    clock, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return clock * 1e3, processor * 1e3, done.returncode


def main():
    sinew, files = sys.argv[1], [pathlib.Path(file) for file in sys.argv[2:]]
    root = pathlib.Path(__file__).resolve().parents[2]
    shared = pathlib.Path(os.environ.get("SINEW_SHARED", root / "../shared")) / "models"
    if not files:
        files = [file for file in sorted(shared.glob("*.dae")) if file.stat().st_size > 1_000_000]
    for file in files or sorted((root / "configs").glob("*.dae")):
        pairs = [(run([sinew, "info", file]), run(["assimp", "info", file])) for _ in range(PAIRS + 1)][1:]
        if any(theirs[2] for _, theirs in pairs):
            print(f"{file.name}: assimp cannot read it")
            continue
        middle = lambda whose, what: statistics.median(pair[whose][what] for pair in pairs)
        ratio = lambda what: statistics.median(theirs[what] / ours[what] for ours, theirs in pairs)
        print(
            f"{file.name:<32} {file.stat().st_size / 1e6:6.2f} MB: info {middle(0, 0):6.1f} ms, assimp {middle(1, 0):6.1f} ms, "
            f"{ratio(0):.2f} times as fast; of the processor {middle(0, 1):.1f} and {middle(1, 1):.1f} ms, {ratio(1):.2f} times"
        )


main()
