"""Hands for the entries of the muscle panel."""

from drive import Atspi, run, walk


def named(window, name):
    """The entries of this name, in their order."""
    return [node for node in walk(window.root) if node.get_name() == name and node.get_role_name() in ("text", "entry")]


def text(node):
    return Atspi.Text.get_text(node, 0, Atspi.Text.get_character_count(node))


def enter(node, what):
    box = node.get_extents(Atspi.CoordType.WINDOW)
    run("xdotool", "mousemove", box.x + box.width // 2, box.y + box.height // 2, "click", 1)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--", what)
    run("xdotool", "key", "Return")


def title(window):
    return run("xdotool", "getwindowname", window.window).decode().strip()
