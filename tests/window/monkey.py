"""Ten thousand random events: keys, clicks, drags and wheel turns all over the window. Nothing may be critical, nothing may be warned of, nothing may panic
or hang, and memory may not grow by a fifth. SINEW_WINDOW_MANAGER names the window manager under which that is tried, none without.

usage: monkey.py PROGRAM FOLDER CONFIGS    (SINEW_MONKEY_SEED and SINEW_MONKEY_EVENTS choose another run)
"""

import collections
import os
import random
import shutil
import subprocess
import sys
import threading
import time

from drive import Window, complaints, configs, fail, folder, told, wait

SEED = int(os.environ.get("SINEW_MONKEY_SEED", "1"))
EVENTS = int(os.environ.get("SINEW_MONKEY_EVENTS", "10000"))
SECONDS = float(os.environ.get("SINEW_MONKEY_SECONDS", "900"))
BATCH = 40
WIDTH, HEIGHT = 1280, 840

# All keys of the table but the ones that leave or close; dialogs are left by Escape.
KEYS = (
    "space ctrl+shift+space Left Right ctrl+Left ctrl+Right shift+Left shift+Right Up Down bracketleft bracketright backslash l i o k shift+k Prior Next "
    "Home Return period 1 3 7 9 5 ctrl+1 ctrl+3 ctrl+7 ctrl+9 f w a s d q e v g r b j n shift+n t c x m h p slash shift+h alt+h "
    "alt+Up alt+Down alt+Left alt+Right ctrl+z ctrl+shift+z ctrl+c F5 F9 F11 F10 F1 ctrl+question Tab shift+Tab Escape Escape Escape ctrl+Next ctrl+Prior Delete minus 0 comma"
).split()


# GTK counts wrongly which widgets are pressed where a press ends elsewhere than it began, as at the end of a drag; every program has that. The stack at
# that warning holds GTK's dispatch of events alone (looked at in 4.8).
# GTK 4.8's own timer for tooltips asks the surface of a popover that has closed meanwhile, such as the context menu of an entry. Nothing of ours is on that stack.
KNOWN = (
    "gdk_surface_get_device_position: assertion",
    "_gtk_widget_find_at_coords: assertion",
    "Broken accounting of active state",
)


class Ear(threading.Thread):
    """Hears what a program complains of, so that its pipe never fills."""

    def __init__(self, window):
        super().__init__(daemon=True)
        self.stream, self.bad, self.last = window.process.stderr, [], collections.deque(maxlen=400)
        self.start()

    def run(self):
        for line in self.stream:
            self.last.append(line)
            if not any(known in line for known in KNOWN):
                self.bad += complaints([line])


def event(dice):
    """One event as words of xdotool."""
    # The buttons that close and fold away the window are left alone.
    x, y = dice.randrange(WIDTH), dice.randrange(HEIGHT)
    if y < 50 and x > WIDTH - 150:
        x -= 400
    at = ["mousemove", x, y]
    kind = dice.random()
    if kind < 0.35:
        return ["key", dice.choice(KEYS)]
    if kind < 0.55:
        return at
    if kind < 0.75:
        return at + ["click", dice.choice((1, 1, 1, 1, 2, 3))]
    if kind < 0.85:
        return at + ["click", "--repeat", dice.randrange(1, 6), dice.choice((4, 5))]
    way = ["mousemove_relative", "--", dice.randrange(-200, 200), dice.randrange(-150, 150)]
    button = dice.choice((1, 1, 1, 2, 3))
    held = dice.choice((None, None, "shift", "ctrl"))
    # A drag of the header would take the window off the screen, where GTK finds no monitor for its menus.
    drag = ["mousemove", x, max(y, 60)] + ["mousedown", button] + way + way + ["mouseup", button]
    return drag if held is None else ["keydown", held] + drag + ["keyup", held]


def resident(window):
    with open(f"/proc/{window.process.pid}/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def at_rest(window):
    """Kibibytes once everything that was opened is closed again."""
    for _ in range(6):
        window.key("Escape")
    time.sleep(0.5)
    return min(resident(window) for _ in range(3) if not time.sleep(0.2))


def start():
    # Copies, since stepping through the folder and saving are among the keys.
    samples = os.path.join(folder, "samples")
    shutil.copytree(configs, samples, dirs_exist_ok=True)
    window = Window(os.path.join(samples, "walker.dae"), flat=False)
    subprocess.run(["xdotool", "windowsize", window.window, str(WIDTH), str(HEIGHT)], check=False)
    window.get("slider", "Time")
    return window, Ear(window)


def main():
    os.environ["G_DEBUG"] = ""  # the ear judges what is critical
    os.chdir(folder)
    dice = random.Random(SEED)
    manager = os.environ.get("SINEW_WINDOW_MANAGER")
    managing = subprocess.Popen([manager], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) if manager else None
    if managing:
        has_one = lambda: subprocess.run(["xdotool", "get_num_desktops"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
        wait(f"{manager} manages windows", has_one)
    window, ear = start()
    begun, done, warm, starts = time.monotonic(), 0, None, 1
    since = 0
    while done < EVENTS and time.monotonic() - begun < SECONDS:
        words = ["windowmove", window.window, "0", "0"] + [str(word) for _ in range(BATCH) for word in event(dice)]
        try:
            subprocess.run(["xdotool", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)
        except subprocess.TimeoutExpired:
            fail(f"the window hangs after {done} events")
        done, since = done + BATCH, since + BATCH
        code = window.process.poll()
        if ear.bad or code:
            fail(f"seed {SEED}: {code} after {done} events: {''.join(ear.bad)}\nall it said last:\n{''.join(ear.last)}\nthe last were {' '.join(words)}")
        if code is not None:
            # The menu was found, and in it a way to leave.
            (window, ear), warm, since, starts = start(), None, 0, starts + 1
        elif warm is None and since >= 2000:
            warm = at_rest(window)
    wait("the window still answers", lambda: window.find_root() is not None)
    now = at_rest(window)
    print(f"{done} events in {time.monotonic() - begun:.0f} s, {starts} starts, memory {warm or now} -> {now} KiB", flush=True)
    if warm and now > warm * 1.2:
        fail(f"memory grew from {warm} to {now} KiB")
    for _ in range(6):
        window.key("Escape")
    window.process.terminate()
    window.process.wait(20)
    ear.join(5)
    if ear.bad:
        fail("".join(ear.bad))
    if managing:
        managing.terminate()
    told(f"{done} random events" + (f" under {manager}" if manager else ""))
    print("all is so")


sys.setrecursionlimit(5000)
main()
