"""The keyboard and the names: what Tab goes through, Enter opens and Esc leaves, and that whatever takes the keyboard says what it is. Run as drive.py is."""

import os

from drive import CLIP, Atspi, GLib, Window, fail, run, steadily, told, value, wait, walk, write
from hands import at, click, focus_picture

# What GTK before 4.10 lets nobody name: the button within a list that unfolds, and the rows of lists.
NAMELESS = ("combo box", "list", "table", "table row")


def focused(window):
    has = lambda node: node.get_parent() and node.get_state_set().contains(Atspi.StateType.FOCUSED)
    return steadily(lambda: next(filter(has, walk(window.root)), None))


def described(node):
    """What tells one thing that takes the keyboard from another: its role and name, and those of the next thing above it that has a name."""
    above = node and node.get_parent()
    while above and not above.get_name():
        above = above.get_parent()
    return above and (node.get_role_name(), node.get_name(), above.get_role_name(), above.get_name())


def press(window, key):
    """A key that moves the keyboard elsewhere, and where it is then."""
    before = described(focused(window))
    window.key(key)
    return wait(f"{key} moves on from {before}", lambda: (now := described(focused(window))) and now != before and now)


def test_order(window):
    click(*at(window.get("entry", "Find a node")))
    wait("the search has the keyboard", lambda: described(focused(window))[1] == "Find a node")
    if press(window, "Tab")[2:] != ("list", "Scene tree"):
        fail(f"Tab goes from the search to the tree: {described(focused(window))}")
    seen = []
    while len(seen) < 90:
        here = press(window, "Tab")
        if here[1] == "Find a node":
            break
        seen.append(here)
    else:
        fail(f"Tab comes round: {seen}")
    if any(where[2:] == ("list", "Scene tree") for where in seen):
        fail("Tab leaves the tree as one thing")
    nameless = [here for here in seen if here[2] not in NAMELESS and (not here[1] or here[1].startswith("Gtk") or here[1].startswith("Sinew"))]
    if nameless:
        fail(f"these take the keyboard and do not say what they are: {nameless}")
    names = [here[1] for here in seen]
    # Search, tree, tools, picture, right side, timeline, header.
    places = [names.index(name) for name in ("Move the model", "Viewport", "Display", "Meshes", "Play", "Time", "Open", "Main menu")]
    if places != sorted(places):
        fail(f"Tab goes from left to right and down: {names}")
    if press(window, "shift+Tab")[1] != "Main menu":
        fail("Shift+Tab goes back")
    told("Tab goes round by all that can be worked, each with its name, and through the tree in one step")


def test_unfolding(window):
    row = wait("the node has a row", lambda: next((node for node in walk(window.root) if node.get_name() == "Node"), None))
    click(*at(row))
    wait("it is looked at", lambda: window.find("button", "Selection alone"))
    time = window.get("slider", "Time")
    time.set_current_value(0.5)
    matrix = window.get("button", "Matrix")
    unfolded = lambda: matrix.get_state_set().contains(Atspi.StateType.EXPANDED)
    for _ in range(8):
        if press(window, "Tab")[1] == "Matrix":
            break
    window.key("Return")
    wait("Enter unfolds the matrix", unfolded)
    window.key("Return")
    wait("and folds it", lambda: not unfolded())
    press(window, "Tab")
    if abs(value(time) - 0.5) > 1e-6:
        fail("nothing else came of it")
    told("Enter unfolds what is folded; Tab goes on from there")


def test_deep_tree():
    """Thirty bones one below the other: their names are legible, and the row that is clicked stays where it is."""
    above = "".join(f'<node id="deep{level}" name="Bone {level:02}">' for level in range(30))
    node = next(line for line in CLIP.splitlines() if 'id="Node"' in line)
    window = Window(write("deep.dae", CLIP.replace(node, above + node + "</node>" * 30)))
    label = lambda name: next((node for node in walk(window.root) if node.get_name() == name and node.get_role_name() == "label"), None)
    row = wait("a bone has a row", lambda: label("Bone 05"))
    place = at(row)
    click(*place)
    wait("the inspector comes up", lambda: window.find("button", "Selection alone"))
    wait("the row stays under the pointer", lambda: abs(at(label("Bone 05"))[1] - place[1]) <= 2)
    window.key("End")
    search = window.get("entry", "Find a node").get_extents(Atspi.CoordType.WINDOW)

    def legible():
        box = label("Bone 29").get_extents(Atspi.CoordType.WINDOW)
        return box.width > 60 and box.x + box.width <= search.x + search.width + 12

    wait("the deepest name has room within the pane", legible)
    window.quit()
    told("deep trees are legible and stand still")


def test_leaving(window, broken):
    focus_picture()
    window.key("alt+Home")
    wait("the start page has the keyboard", lambda: described(focused(window))[1] == "Open files")
    if press(window, "Tab")[1] != "Back to the scene" or press(window, "Tab")[1] != "Biceps from measured radii":
        fail("the demos follow the buttons, by name")
    window.key("Escape")
    wait("Esc sends the start page away", lambda: not window.shows("Back to the scene"))
    wait("the picture has the keyboard again", lambda: described(focused(window))[1] == "Viewport")
    window.quit()
    window = Window(broken, opens=False)
    wait("what is wrong is said", lambda: window.shows("cannot be opened"))
    window.get("button", "Close this bar")
    window.key("Escape")
    wait("Esc folds the bar away", lambda: not window.shows("cannot be opened"))
    wait("and an empty tree says why it is", lambda: window.shows("No file is open."))
    window.quit()
    told("Esc leaves the start page and the bar of errors")


def test_small(path):
    """In a narrow picture the numbers of a tool stay within it."""
    os.environ["LC_ALL"] = "ru_RU.UTF-8"
    window = Window(path)
    run("xdotool", "windowsize", window.window, 800, 600)
    tools = window.get("button", "Переместить модель")
    panel = window.get("page tab", "Мышца")
    focus_picture()
    for key, names in (("g", "XYZ"), ("r", "XYZ"), ("s", "X")):
        window.key(key)
        boxes = [window.get("spin button", name) for name in names]

        def within():
            last, right = boxes[-1].get_extents(Atspi.CoordType.WINDOW), panel.get_extents(Atspi.CoordType.WINDOW).x
            first = boxes[0].get_extents(Atspi.CoordType.WINDOW)
            return first.width > 40 and first.x > at(tools)[0] and last.x + last.width < right

        wait(f"the numbers of {key} fit", within)
    window.quit()
    os.environ["LC_ALL"] = "C.UTF-8"
    told("the numbers of a tool fit into a narrow picture")


def main():
    path, broken = write("clip.dae", CLIP), write("broken.dae", "<COLLADA><x></COLLADA>")
    window = Window(path)
    window.get("slider", "Time")
    test_order(window)
    test_unfolding(window)
    test_leaving(window, broken)
    test_deep_tree()
    # The size of the window is remembered, so what needs a small one comes last.
    test_small(path)
    print("all is so")


if __name__ == "__main__":
    try:
        main()
    except GLib.Error as error:
        fail(f"the accessibility tree: {error}")
