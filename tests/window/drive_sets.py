"""Attaches a set of muscles from the menu, mirrors one and takes both back, as a person would. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Window, called, configs, folder, told, wait, walk
from drive_hands import click, muscle_page, title
from drive_several import choose


def test_sets():
    for name in ("walker.dae", "walker.png"):
        shutil.copy(os.path.join(configs, name), os.path.join(folder, name))
    window = Window(os.path.join(folder, "walker.dae"))
    muscle_page(window)
    legs = "Muscles of the legs"
    buttons = lambda: [node for node in walk(window.root) if node.get_name() == "New" and node.get_role_name().endswith("button")]
    click(wait("there is a button New", buttons)[0])
    items = lambda: [called(node) for node in walk(window.root) if node.get_role_name() == "menu item"]
    wait(f"the menu offers {legs}", lambda: legs in items())
    # By the keyboard, past five ready muscles and the set of the arms.
    window.key(*(["Down"] * 6), "Return")
    wait("the muscles of both legs are there", lambda: window.shows("64 muscles are attached to the figure"))
    wait("they are not saved", lambda: title(window).startswith("•"))
    told("a set of muscles is attached from the menu")

    wait("the first muscle is shown", lambda: window.shows("glut_med1_r"))
    choose(window, "Mirror")
    wait("its image goes to the other thigh", lambda: window.shows("glut_med1_l 2"))
    window.get("button", "Undo").do_action(0)
    wait("Undo takes the image away", lambda: not window.shows("glut_med1_l 2"))
    window.get("button", "Undo").do_action(0)
    wait("Undo takes the set away", lambda: not title(window).startswith("•"))
    told("a muscle is mirrored, and both steps are taken back")
    window.quit()


if __name__ == "__main__":
    test_sets()
    print("all is so")
