"""Attaches a muscle to the bones of a clip as a person would, edits and saves it, and comes back after a crash. Run as drive.py is, whose hands it uses."""

import os
import signal

from drive import Atspi, Window, fail, folder, run, told, value, wait, walk
from drive_hands import click, enter, muscle_page, named, new_muscle, open_curl, text, title


def test_attaching():
    window, elbow = open_curl()
    elbow.set_current_value(80.0)
    wait("the joint found in the clip bends", lambda: window.shows("80.0°"))
    told("the elbow of a clip bends without a muscle file")

    new_muscle(window, "Biceps in human")
    wait("a muscle is there, not saved", lambda: title(window).startswith("•"))
    wait("it goes to the forearm", lambda: window.shows("forearm"))
    contraction = window.get("slider", "Contraction")
    before = value(contraction)
    elbow.set_current_value(120.0)
    wait("the contraction follows the elbow", lambda: value(contraction) > before + 5.0)
    told("a new muscle joins the bones of the elbow, and both sliders are one state")

    box = contraction.get_extents(Atspi.CoordType.WINDOW)
    across = lambda part: (box.x + round(box.width * part), box.y + box.height // 2)
    run("xdotool", "mousemove", *across(value(contraction) / 100.0), "mousedown", 1)
    for part in (0.6, 0.5, 0.45, 0.4):
        run("xdotool", "mousemove", *across(part), "sleep", 0.05)
    run("xdotool", "mouseup", 1)
    wait("the contraction follows the hand", lambda: abs(value(contraction) - 40.0) < 6.0 and value(elbow) < 110.0)
    elbow.set_current_value(120.0)
    wait("the elbow is bent again", lambda: abs(value(elbow) - 120.0) < 1e-6)
    told("the contraction is dragged")

    offset = lambda: named(window, "Insertion: offset along the bone’s Y axis")[0]
    was = wait("the offset of the insertion is shown", lambda: text(offset()))
    enter(offset(), "61.5")
    wait("a typed offset is taken", lambda: text(offset()) == "61.50")
    window.get("button", "Undo").do_action(0)
    wait("Undo brings the offset back", lambda: text(offset()) == was)
    window.get("button", "Redo").do_action(0)
    wait("Redo moves the end again", lambda: text(offset()) == "61.50")
    told("an end is moved, Undo and Redo")

    pick = lambda: next(node for node in walk(window.root) if node.get_name() == "Pick the bone of the insertion")
    click(wait("there is a button to pick a bone", pick))
    wait("a hint says what to click", lambda: window.shows("Click the bone that carries the insertion"))
    window.key("Escape")
    wait("Esc leaves picking", lambda: not window.shows("Click the bone that carries the insertion"))
    told("picking says what to do, and Esc leaves it")

    # What is not saved outlives the program.
    state = os.path.join(os.environ["XDG_STATE_HOME"], "sinew")
    wait("what is not saved is written down", lambda: any("61.5" in open(os.path.join(state, name)).read() for name in os.listdir(state)))
    window.process.send_signal(signal.SIGKILL)
    window.process.wait()
    window = Window()
    restore = window.get("button", "Restore")
    click(restore)
    wait("the muscle comes back, not saved", lambda: title(window).startswith("•") and "curl.dae" in title(window))
    # A key that takes back goes to the picture, not into the search.
    searches = lambda: any(node.get_state_set().contains(Atspi.StateType.FOCUSED) for node in named(window, "Find a node"))
    wait("the search has not got the keyboard", lambda: named(window, "Find a node") and not searches())
    muscle_page(window)
    wait("it is as it was", lambda: text(offset()) == "61.50")
    told("a crash loses nothing")

    window.key("ctrl+shift+s")
    path = os.path.join(folder, "attached.yaml")
    dialog = wait("a dialog asks for a name", window.others)[0]
    run("xdotool", "windowfocus", dialog)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--", path)
    run("xdotool", "key", "Return")
    wait("the muscle is saved with its clip", lambda: "curl.dae" in open(path).read() and "61.5" in open(path).read())
    wait("the title is unmarked", lambda: not title(window).startswith("•"))
    wait("nothing is left to recover", lambda: not os.listdir(state))
    told("saving under a name")
    run("xdotool", "windowfocus", window.window)
    window.quit()

    window = Window(path)
    wait("the muscle is read again, with its clip", lambda: "attached.yaml" in title(window))
    muscle_page(window)
    wait("its end is where it was", lambda: text(offset()) == "61.50")
    # Another program writes the file while there are changes here.
    enter(offset(), "70")
    wait("the change is not saved", lambda: title(window).startswith("•"))
    with open(path) as file:
        theirs = file.read().replace("61.5", "33.25")
    with open(path, "w") as file:
        file.write(theirs)
    asked = wait("the window asks which of both is to be", window.others)[0]
    run("xdotool", "windowfocus", asked)
    run("xdotool", "key", "Return")
    wait("the question goes", lambda: not window.others())
    wait("the own change stays, not saved", lambda: text(offset()) == "70.00" and title(window).startswith("•"))
    if "33.25" not in open(path).read():
        fail("the other program's file stays as it is until it is saved over")
    told("a file changed by both is asked about")
    window.process.send_signal(signal.SIGKILL)
    window.process.wait()


test_attaching()
print("all is so")
