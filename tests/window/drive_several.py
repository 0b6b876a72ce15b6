"""Copies, renames and deletes a muscle as a person would. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Window, called, configs, fail, folder, told, wait, walk
from drive_hands import click, enter, muscle_page, named, reveal, text, title


def choose(window, item):
    """Chooses from the menu beside the list of muscles."""
    label = "Duplicate, mirror, delete or replace the muscle"
    buttons = lambda: [node for node in walk(window.root) if node.get_name() == label and node.get_role_name().endswith("button")]
    button = wait("there is a menu for the muscle", buttons)[0]
    reveal(button)
    click(button)
    items = lambda: [called(node) for node in walk(window.root) if node.get_role_name() == "menu item"]
    wait(f"the menu offers {item}", lambda: item in items())
    # By the keyboard: the menu says where its items are only while it is still coming up.
    place = ["Duplicate", "Mirror", "Delete"].index(item)
    window.key(*(["Down"] * place), "Return")


def test_several():
    arm = os.path.join(folder, "arm.yaml")
    shutil.copy(os.path.join(configs, "biceps-human.yaml"), arm)
    before = open(arm, encoding="utf-8").read()
    window = Window(arm)
    muscle_page(window)
    name = lambda: text(named(window, "Name")[0])
    first = wait("the muscle has a name", name)

    choose(window, "Duplicate")
    copy = wait("the copy is shown under a name of its own", lambda: name() != first and name())
    if first not in copy:
        fail(f"the copy of {first} is called {copy}")
    wait("the copy is not saved yet", lambda: title(window).startswith("•"))
    told("a muscle is copied")

    enter(named(window, "Name")[0], "Long head")
    wait("the copy has the typed name", lambda: name() == "Long head")
    window.key("ctrl+s")
    wait("it is saved", lambda: not title(window).startswith("•"))
    after = open(arm, encoding="utf-8").read()
    if "Long head" not in after or first not in after or len(after) <= len(before):
        fail("the file has not both muscles")
    told("the copy is renamed and saved")

    choose(window, "Delete")
    wait("the first is shown again", lambda: name() == first)
    window.get("button", "Undo").do_action(0)
    wait("Undo brings the copy back", lambda: "Long head" in name() or window.shows("Long head"))
    window.get("button", "Redo").do_action(0)
    wait("Redo takes it away again", lambda: name() == first and not window.shows("Long head"))
    choose(window, "Delete")
    wait("the last one of a file stays", lambda: name() == first and window.shows("at least 1 muscle"))
    told("the copy is deleted, brought back and deleted; the last muscle of a file stays")
    window.key("ctrl+s")
    wait("it is saved", lambda: not title(window).startswith("•"))
    window.quit()


if __name__ == "__main__":
    test_several()
    print("all is so")
