"""Drives tree, inspector, start page, sessions: what is in a file, and how files come and go. Run as drive.py is."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
from drive import Atspi, Window, configs, fail, folder, run, still, told, value, wait  # noqa: E402,F401


def labels(window):
    """All texts that are shown."""
    found = []

    def within(node):
        if node is None or not node.get_state_set().contains(Atspi.StateType.VISIBLE):
            return
        found.append(node.get_name() or "")
        for index in range(node.get_child_count()):
            within(node.get_child_at_index(index))

    window.root.clear_cache()
    for index in range(window.root.get_child_count()):
        within(window.root.get_child_at_index(index))
    return found


def click(window, name, role="label"):
    box = window.get(role, name).get_extents(Atspi.CoordType.WINDOW)
    run("xdotool", "mousemove", box.x + box.width // 2, box.y + box.height // 2, "click", 1)


def test_inspector():
    window = Window(os.path.join(configs, "curl.dae"))
    wait("the tree lists the bones", lambda: window.count("forearm") == 1)
    if window.shows("Rotate manually"):
        fail("nothing is selected, so there is nothing to inspect")
    click(window, "forearm")
    wait("the inspector shows a bone", lambda: window.shows("Rotate manually"))
    wait("it tells the joint's angle", lambda: window.shows("upper_arm – forearm – hand: "))
    told("a bone selected in the tree is inspected")

    before = still(window)
    turn = window.get("slider", "Rotation about X, degrees")
    turn.set_current_value(60.0)
    wait("the picture follows the hand", lambda: window.picture() != before)
    angle = next(text for text in labels(window) if text.startswith("upper_arm – forearm – hand: "))
    window.key("ctrl+z")
    wait("Ctrl+Z takes the turn back", lambda: abs(value(turn)) < 1e-9 and still(window) == before)
    wait("the angle goes back too", lambda: not window.shows(angle))
    window.key("ctrl+shift+z")
    wait("Ctrl+Shift+Z turns again", lambda: abs(value(turn) - 60.0) < 1e-9)
    window.get("button", "Reset all").do_action(0)
    wait("Reset all takes all turns back", lambda: abs(value(turn)) < 1e-9 and window.picture() == before)
    told("a joint is turned by hand, undone, done again and reset")

    time = window.get("slider", "Time")
    first = next(text for text in labels(window) if text.startswith("upper_arm – forearm – hand: "))
    time.set_current_value(2.0)
    wait("the angle follows the clip", lambda: not window.shows(first))
    time.set_current_value(0.0)

    click(window, "arm")
    wait("a mesh is inspected", lambda: window.shows("triangles, ") and window.shows("Skin: "))
    run("xdotool", "mousemove", 510, 260, "click", 1)
    wait("a clicked vertex is explained", lambda: any(text.startswith("How vertex ") for text in labels(window)) and window.shows("Sum"))
    wait("a second point is wanted", lambda: window.shows("Click a second point"))
    run("xdotool", "mousemove", 512, 420, "click", 1)
    wait("two points have a distance", lambda: window.shows("Distance between the last two clicked points: "))
    told("a vertex is explained, and the distance of two points measured")
    window.quit()


SESSION = """sinew_session:
  files: [FILE]
  time: 1.5
  hidden: []
  turned:
    - {node: 4, name: forearm, degrees: [30.0, 0.0, 0.0]}
  selected: {node: 4, name: forearm}
  shading: flat
  shown: [mesh, muscle, materials, grid, depth-test, bones]
"""


def test_session_file():
    path = os.path.join(folder, "curl.session.yaml")
    with open(path, "w") as file:
        file.write(SESSION.replace("FILE", os.path.join(configs, "curl.dae")))
    window = Window(path)
    slider = window.get("slider", "Time")
    wait("the session's moment is shown", lambda: abs(value(slider) - 1.5) < 1e-6)
    wait("the session's selection is inspected", lambda: window.shows("Rotate manually"))
    wait("the session's turn is there", lambda: abs(value(window.get("slider", "Rotation about X, degrees")) - 30.0) < 1e-6)
    told("a session file opens: clip, moment, selection, a joint turned by hand")
    window.quit()
    with open(path, "w") as file:
        file.write("sinew_session:\n  time: soon\n")
    window = Window(path, opens=False)
    wait("a broken session file is told with its line", lambda: window.shows("cannot be opened") and window.shows("ine 2"))
    told("a broken session file says where")
    window.quit()


def test_start_page():
    window = Window()
    wait("the built-in biceps is there", lambda: window.find("slider", "Contraction"))
    if window.shows("No file is open"):
        fail("the start page stands over the biceps")
    window.key("alt+Home")
    wait("Alt+Home brings the start page", lambda: window.shows("Open another file"))
    window.get("button", "Back to the scene").do_action(0)
    wait("Back takes it away", lambda: not window.shows("Open another file"))
    window.key("ctrl+w")
    wait("with nothing open it comes by itself", lambda: window.shows("No file is open"))
    click(window, "Biceps and triceps, arm flexing at the elbow")
    wait("a demo opens", lambda: window.count("forearm") > 0)
    wait("the page goes", lambda: not window.shows("No file is open"))
    told("the start page comes, goes, and opens demos")
    window.quit()


if __name__ == "__main__":
    test_inspector()
    test_session_file()
    test_start_page()
    print("all is so")
