"""Drives ghosts, paths, comparison, isolating and the narrow window. Run as drive.py is."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
from drive import Atspi, Window, configs, fail, folder, pressed, run, still, told, value, wait  # noqa: E402,F401
from contents import click, labels  # noqa: E402


def settle(window, what, act, changed=True):
    """Acts and returns the picture that comes of it."""
    before = still(window)
    act()
    wait(what, lambda: (window.picture() != before) == changed)
    return still(window)


def test_ghosts():
    window = Window(os.path.join(configs, "curl.dae"))
    time = window.get("slider", "Time")
    wait("the tree lists the bones", lambda: window.count("hand") == 1)
    run("xdotool", "mousemove", 420, 640, "click", 1)  # the keyboard goes to the picture
    time.set_current_value(1.0)
    alone = still(window)
    settle(window, "H shows the moments around", lambda: window.key("h"))
    more = window.get("spin button", "Frames after")
    settle(window, "more ghosts change the picture", lambda: more.set_current_value(5.0))
    settle(window, "a longer step too", lambda: window.get("spin button", "Step, frames").set_current_value(2.0))
    window.key("h")
    wait("H again shows the present one alone", lambda: window.picture() == alone)
    told("ghosts come and go, with their number and step")

    click(window, "hand")
    wait("the hand is selected", lambda: window.shows("Rotate manually"))
    run("xdotool", "mousemove", 420, 640)
    settle(window, "P draws the path of the bone", lambda: window.key("p"))
    settle(window, "P again takes it away", lambda: window.key("p"))
    told("the path of a bone comes and goes")

    window.key("slash")
    wait("/ shows the selection alone", lambda: window.get("button", "Selection alone") and pressed(window.get("button", "Selection alone")))
    window.key("slash")
    wait("/ again shows all", lambda: not pressed(window.get("button", "Selection alone")))
    click(window, "arm")
    run("xdotool", "mousemove", 420, 640)
    shown = still(window)
    window.key("shift+h")
    wait("Shift+H hides the selection", lambda: window.picture() != shown)
    window.key("alt+h")
    wait("Alt+H shows everything", lambda: window.picture() == shown)
    told("the selection is shown alone, hidden, and shown again")
    window.quit()


def test_comparison():
    window = Window(os.path.join(configs, "curl.dae"))
    wait("the tree lists the bones", lambda: window.count("hand") == 1)
    time = window.get("slider", "Time")
    time.set_current_value(1.0)
    run("xdotool", "mousemove", 420, 640, "click", 1)
    alone = still(window)
    window.key("d")
    wait("the difference is told", lambda: window.shows("Largest vertex distance: "))
    wait("the picture shows two", lambda: window.picture() != alone)
    window.key("d")
    wait("and one again", lambda: not window.shows("Largest vertex distance: "))
    told("both skinnings stand side by side at the press of D")
    window.quit()

    session = os.path.join(folder, "two.session.yaml")
    with open(session, "w") as file:
        curl = os.path.abspath(os.path.join(configs, "curl.dae"))
        file.write(f"sinew_session:\n  files: [{curl}]\n  shown: [mesh, materials, depth-test]\n  compared: {{file: {curl}, later: 0.5, aside: 0.3}}\n")
    window = Window(session)
    wait("the largest joint distance is told", lambda: any(text.startswith("Largest joint distance: ") for text in labels(window)))
    # The status line and the panel say the same, and name a joint.
    found = [text for text in labels(window) if text.startswith("Largest joint distance: ")]
    if not all("(" in text for text in found):
        fail(f"no joint is named: {found}")
    ahead = window.get("spin button", "Time offset, s")
    ahead.set_current_value(0.0)
    wait("at the same moment they are the same", lambda: any("distance: 0.0000 m" in text for text in labels(window)))
    told("a session compares two files, and the difference follows the shift in time")
    window.quit()


def test_narrow():
    window = Window(os.path.join(configs, "curl.dae"))
    wait("the tree lists the bones", lambda: window.count("hand") == 1)
    run("xdotool", "windowsize", window.window, 820, 620)
    wait("the tree gives way", lambda: not window.shows("hand"))
    window.get("button", "Scene tree").do_action(0)
    wait("the tree comes back in the panel's place", lambda: window.shows("hand") and not window.shows("Shading"))
    click(window, "hand")
    wait("the inspector is there", lambda: window.shows("Rotate manually"))
    window.get("button", "Right panel").do_action(0)
    wait("the panel takes the tree's place", lambda: window.shows("Shading") and not window.shows("Rotate manually"))
    run("xdotool", "windowsize", window.window, 1280, 800)
    wait("with room for both, both are there", lambda: window.shows("Shading") and window.shows("Rotate manually"))
    told("in a narrow window tree with inspector and panel take turns")

    window.quit()


if __name__ == "__main__":
    test_ghosts()
    test_comparison()
    test_narrow()
    print("all is so")
