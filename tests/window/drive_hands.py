"""Hands for the muscle panel."""

import os
import shutil
import time

import hands
from drive import Atspi, Window, called, configs, folder, run, steadily, wait, walk


def named(window, name):
    """The entries of this name, in their order."""
    fits = lambda node: node.get_name() == name and node.get_role_name() in ("text", "entry")
    return steadily(lambda: list(filter(fits, walk(window.root))))


def text(node):
    return Atspi.Text.get_text(node, 0, Atspi.Text.get_character_count(node))


def click(node):
    hands.click(*hands.at(node))


def reveal(node):
    """Turns the wheel over the page that a node lies on until it is seen."""
    page, parent = None, node.get_parent()
    while parent and parent.get_role_name() != "application":
        page = parent if parent.get_role_name() == "scroll pane" else page
        parent = parent.get_parent()
    if not page:
        return
    box = page.get_extents(Atspi.CoordType.WINDOW)
    run("xdotool", "mousemove", box.x + 9, box.y + box.height // 2)
    for _ in range(40):
        down = hands.at(node)[1] - box.y
        if 20 <= down <= box.height - 20:
            return
        run("xdotool", "click", 4 if down < 20 else 5)
        time.sleep(0.1)


def focused(node):
    """Clicks an entry, and again where it moved on while the page was still laid out."""
    reveal(node)
    click(node)
    for _ in range(20):
        if node.get_state_set().contains(Atspi.StateType.FOCUSED):
            return True
        time.sleep(0.05)
    return False


def enter(node, what):
    wait("an entry that is clicked takes what is typed", lambda: focused(node))
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--", what)
    run("xdotool", "key", "Return")


def title(window):
    return run("xdotool", "getwindowname", window.window).decode().strip()


def muscle_page(window):
    page(window, "Muscle")


def page(window, *names):
    """A page of the right-hand side, by the tab over it that has one of these names."""
    roles = ("page tab", "toggle button", "radio button", "push button")
    tab = lambda: next((node for node in walk(window.root) if node.get_name() in names and node.get_role_name() in roles), None)
    node = wait(f"there is a tab over the page {names[0]}", tab)

    def shown():
        click(node)
        states = node.get_state_set()
        return any(states.contains(state) for state in (Atspi.StateType.SELECTED, Atspi.StateType.CHECKED, Atspi.StateType.PRESSED))

    wait(f"the page {names[0]} comes up", shown)


def open_curl():
    """A copy of the curling arm in a window at the page of muscles, and the slider of its elbow."""
    clip = os.path.join(folder, "curl.dae")
    shutil.copy(os.path.join(configs, "curl.dae"), clip)
    window = Window(clip)
    muscle_page(window)
    return window, window.get("slider", "Elbow angle")


def new_muscle(window, name):
    """Chooses a ready muscle from the menu of the button New."""
    buttons = lambda: [node for node in walk(window.root) if node.get_name() == "New" and node.get_role_name().endswith("button")]
    click(wait("there is a button New", buttons)[0])
    items = lambda: [node for node in walk(window.root) if node.get_role_name() == "menu item" and name in called(node)]
    click(wait(f"the menu offers {name}", items)[0])
