"""Times `sinew render` and `f3d --output` on the same files, whole processes, 1920 × 1080.

    python3 benches/peers/f3d.py target/release/sinew FILE…      (needs f3d, and xvfb-run where there is no display)
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 9


def median(call):
    """Median milliseconds of a process; `None` where it fails."""
    times = []
    for _ in range(RUNS + 1):
        start = time.perf_counter()
        if subprocess.run(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode:
            return None
        times.append((time.perf_counter() - start) * 1e3)
    return statistics.median(times[1:])


def main():
    if not shutil.which("f3d"):
        print("f3d was not measured: it is not installed")
        return
    if "DISPLAY" not in os.environ and not os.environ.get("SINEW_UNDER_XVFB"):
        if not shutil.which("xvfb-run"):
            print("f3d was not measured: it needs a display, or xvfb-run")
            return
        # One server for all runs, so that its start is in no time.
        os.environ["SINEW_UNDER_XVFB"] = "1"
        os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])
    print(f"{'file':32}{'f3d, ms':>10}{'sinew, ms':>12}{'ratio':>8}")
    with tempfile.TemporaryDirectory() as folder:
        picture = str(pathlib.Path(folder) / "picture.png")
        for file in sys.argv[2:]:
            theirs = median(["f3d", file, "--output", picture, "--resolution", "1920,1080"])
            ours = median([sys.argv[1], "render", file, "-o", picture, "--size", "1920x1080", "--force", "--quiet"])
            if theirs is None or ours is None:
                print(f"{pathlib.Path(file).name:32}could not be drawn by both")
            else:
                print(f"{pathlib.Path(file).name:32}{theirs:10.0f}{ours:12.0f}{theirs / ours:7.1f}×")


main()
