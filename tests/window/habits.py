"""Habits of a desktop: numbers in the language of the window, looks of a session file, the folder of what was saved, weights, fine screens. Run as drive.py is."""

import os
import subprocess

from drive import CLIP, Atspi, Window, configs, fail, folder, pressed, run, still, told, value, wait
from drive_hands import page
from hands import at, click, focus_picture


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(text)
    return path


def text_of(node):
    return Atspi.Text.get_text(node, 0, Atspi.Text.get_character_count(node))


def test_russian_numbers(path):
    os.environ["LC_ALL"] = "ru_RU.UTF-8"
    window = Window(path)
    slider, box = window.get("slider", "Время"), window.get("spin button", "Точное время в секундах")
    wait("the box of the time writes a comma", lambda: text_of(box) == "0,000")
    for typed, seconds in (("0,5", 0.5), ("0.75", 0.75)):
        click(*at(box, 0.2))
        window.key("ctrl+a")
        run("xdotool", "type", "--", typed)
        window.key("Return")
        wait(f"{typed} is read", lambda: abs(value(slider) - seconds) < 1e-6)
    wait("and written with a comma again", lambda: text_of(box) == "0,750")
    window.quit()
    os.environ["LC_ALL"] = "C.UTF-8"
    told("numbers in boxes are written and read in the language of the window")


def edges(window):
    return wait("there is a switch for edges", lambda: window.find("check box", "Wireframe"))


def test_looks_of_a_session(path):
    window = Window(path)
    window.get("slider", "Time")
    focus_picture()
    wait("edges are off", lambda: not pressed(edges(window)))
    window.quit()
    session = write(os.path.join(folder, "looks.yaml"), f"sinew_session:\n  files: [{os.path.basename(path)}]\n  shown: [mesh, wireframe, bones, depth-test]\n")
    for leave in ("quit", "close"):
        window = Window(session)
        window.get("slider", "Time")
        focus_picture()
        wait("the session brings its looks", lambda: pressed(edges(window)))
        # What a hand changes meanwhile is the user's own.
        grid = window.get("check box", "World axes")
        before = pressed(grid)
        window.key("x")
        wait("the axes are switched", lambda: pressed(grid) != before)
        if leave == "close":
            window.key("ctrl+w")
            wait("the looks go with the session", lambda: not pressed(edges(window)))
        window.quit()
        window = Window(path)
        window.get("slider", "Time")
        wait("the looks of a session are not remembered", lambda: not pressed(edges(window)))
        wait("what was changed by hand is", lambda: pressed(window.get("check box", "World axes")) != before)
        window.quit()
    told("the looks of a session file stay with it")


def save_picture(window, path):
    """Saves the picture under a name that is typed into the dialog."""
    window.key("F12")
    dialog = wait("F12 asks for a name", lambda: window.others())[0]
    run("xdotool", "windowfocus", dialog)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--", path)
    run("xdotool", "key", "Return")
    wait("the picture is written", lambda: os.path.getsize(path) > 0)
    wait("the window is alone again", lambda: not window.others())
    run("xdotool", "windowfocus", window.window)


def test_folder_of_what_was_saved():
    """A file manager that writes down what it is asked to show."""
    asked = os.path.join(folder, "asked")
    manager = write(os.path.join(folder, "manager.sh"), f'#!/bin/sh\nprintf %s "$1" > "{asked}"\n')
    os.chmod(manager, 0o755)
    entry = f"[Desktop Entry]\nType=Application\nName=Manager\nExec={manager} %u\nMimeType=inode/directory;\n"
    write(os.path.join(os.environ["XDG_DATA_HOME"], "applications", "manager.desktop"), entry)
    write(os.path.join(os.environ["XDG_CONFIG_HOME"], "mimeapps.list"), "[Default Applications]\ninode/directory=manager.desktop\n")
    window = Window(os.path.join(configs, "biceps.yaml"))
    window.get("slider", "Contraction")
    focus_picture()
    path = os.path.join(folder, "saved", "arm.png")
    os.makedirs(os.path.dirname(path))
    save_picture(window, path)
    wait("what was saved is told", lambda: window.shows("Open folder"))
    window.get("button", "Open folder").do_action(0)
    wait("the folder is shown", lambda: open(asked).read().rstrip("/").endswith("/saved"))
    window.quit()
    told("Open folder opens the folder")


def test_weights():
    window = Window(os.path.join(configs, "..", "tests", "window", "no-such-file.dae"), opens=False)
    wait("a file that is not there is told", lambda: window.shows("cannot be opened"))
    window.quit()
    window = Window(os.path.join(configs, "biceps.yaml"))
    window.get("slider", "Contraction")
    page(window, "Display")
    box = window.get("check box", "Weights of the selected bone")
    focus_picture()
    window.key("w")
    if pressed(box):
        fail("without a selection there are no weights")
    row = wait("the elbow is in the tree", lambda: window.find("label", "Elbow"))
    click(*at(row))
    wait("it is selected", lambda: window.count("Elbow") > 1)
    focus_picture_without_choice(window)
    plain = still(window)
    window.key("w")
    wait("W paints the weights of the selected bone", lambda: pressed(box))
    window.key("w")
    wait("W again does not", lambda: not pressed(box) and window.picture() == plain)
    window.quit()
    told("W paints weights")


def focus_picture_without_choice(window):
    """The keyboard goes to the picture, and what is selected stays: the middle button selects nothing."""
    click(*at(window.get("button", "Undo"), 0.5, 4.0), button=2)


def test_fine_screen(path):
    """Two pixels of the screen a logical one: the picture has them all, and clicks land where they are seen."""
    os.environ["GDK_SCALE"] = "2"
    window = Window(path)
    window.get("slider", "Time")
    run("xdotool", "windowsize", window.window, 1400, 900)
    run("xdotool", "mousemove", 250, 180, "click", 1)
    still(window)
    unselected = window.count("Node")
    # Beside the plate in logical pixels, on it in those of the screen.
    for x, y, more in ((250, 180, 0), (400, 420, 1), (250, 180, 0)):
        run("xdotool", "mousemove", x, y, "click", 1)
        wait(f"a click at {x}, {y} selects: {more > 0}", lambda: window.count("Node") == unselected + more)
    picture = os.path.join(folder, "fine.png")
    save_picture(window, picture)
    width = int(subprocess.run(["identify", "-format", "%w", picture], check=True, stdout=subprocess.PIPE, text=True).stdout)
    if width % 2 or width < 400:
        fail(f"the picture has all pixels of the screen: {width}")
    window.quit()
    del os.environ["GDK_SCALE"]
    told("a fine screen: pixels and clicks")


def test_nothing_to_draw():
    """A file that can be read and holds nothing to look at says so where one looks; another file takes the words away."""
    path = write(os.path.join(folder, "bare.dae"), BARE)
    window = Window(path)
    words = "Nothing in this file can be drawn"
    wait("a bare file says so in the picture", lambda: window.shows(words))
    window.quit()
    window = Window(os.path.join(configs, "walker.dae"))
    window.get("slider", "Time")
    wait("one with a mesh does not", lambda: window.shows("robot") and not window.shows(words))
    window.quit()
    told("a file with nothing to draw says so")


BARE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>
  <library_visual_scenes><visual_scene id="s"><node id="n" name="n"/></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def main():
    path = write(os.path.join(folder, "turn.dae"), CLIP)
    test_russian_numbers(path)
    test_looks_of_a_session(path)
    test_folder_of_what_was_saved()
    test_weights()
    test_nothing_to_draw()
    test_fine_screen(path)
    print("all is so")


if __name__ == "__main__":
    main()
