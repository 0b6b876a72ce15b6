"""Edits a muscle as a person would: types a radius, drags a handle, undoes, saves, opens again. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Window, configs, fail, folder, run, told, value, wait
from drive_hands import enter, named, text, title


def radii(path):
    with open(path) as file:
        line = next(line for line in file if "radiuses" in line)
    return [float(number) for number in line.split("[")[1].split("]")[0].split(",")]


def test_workshop():
    path = os.path.join(folder, "muscle.yaml")
    shutil.copy(os.path.join(configs, "biceps-measured.yaml"), path)
    os.chmod(path, 0o644)
    before = radii(path)
    window = Window(path)
    cell = lambda: wait("the table has its rows", lambda: named(window, "Radius at rest")[2:3])[0]
    wait("the third radius is shown", lambda: abs(float(text(cell())) - before[2]) < 0.01)
    enter(cell(), "31.5")
    wait("a typed radius is taken", lambda: text(cell()) == "31.50")
    wait("the title marks what is not saved", lambda: title(window).startswith("•"))
    told("a typed radius is taken and not yet saved")

    enter(cell(), "-4")
    wait("a negative radius is refused in place", lambda: window.shows("radius") and text(cell()) == "-4")
    wait("the change before stays", lambda: title(window).startswith("•"))
    enter(cell(), "31.5")
    told("a radius that cannot be is refused")

    window.get("button", "Undo").do_action(0)
    wait("Undo brings the radius back", lambda: abs(float(text(cell())) - before[2]) < 0.01)
    wait("the title is unmarked again", lambda: not title(window).startswith("•"))
    window.get("button", "Redo").do_action(0)
    wait("Redo changes it again", lambda: text(cell()) == "31.50")
    told("Undo and Redo")

    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("ctrl+s")
    wait("Ctrl+S writes the file", lambda: abs(radii(path)[2] - 31.5) < 1e-9)
    wait("the title is unmarked after saving", lambda: not title(window).startswith("•"))
    if [radii(path)[node] for node in (0, 1, 3)] != [before[node] for node in (0, 1, 3)]:
        fail("the other radii stay as they were")
    told("Ctrl+S saves")
    window.quit()

    window = Window(path)
    wait("the saved radius is read again", lambda: text(cell()) == "31.50")
    contraction, elbow = window.get("slider", "Contraction"), window.get("slider", "Elbow angle")
    elbow.set_current_value(50.0)
    wait("the contraction follows the elbow", lambda: value(contraction) > 5.0)
    enter(cell(), "33")
    wait("the title marks the change", lambda: title(window).startswith("•"))
    if abs(value(elbow) - 50.0) > 1e-6:
        fail("the elbow stays where it is while the muscle is edited")
    window.key("ctrl+q")

    # The question is a window of its own; its first button lets the changes go.
    asked = wait("a question comes up", window.others)[0]
    size = dict(line.split("=") for line in run("xdotool", "getwindowgeometry", "--shell", asked).decode().split())
    run("xdotool", "mousemove", "--window", asked, int(size["WIDTH"]) // 6, int(size["HEIGHT"]) - 18, "click", 1)
    wait("not saving lets the window close", lambda: window.process.poll() is not None)
    if window.process.returncode != 0 or abs(radii(path)[2] - 31.5) > 1e-9:
        fail("nothing is written without saving")
    told("closing asks about what is not saved")


test_workshop()
print("all is so")
