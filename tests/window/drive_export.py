"""Exports as a person would: opens the dialog, chooses, stops one export and lets others finish. Run as drive.py is, whose hands it uses."""

import os
import shutil
import signal
import struct
import subprocess
import time
import zlib

from drive import Atspi, Window, configs, fail, folder, run, told, wait, walk

out = os.path.join(folder, "out")


def files():
    return sorted(os.listdir(out))


def dialog(window):
    """Opens the export dialog with its key."""
    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("ctrl+e")
    found = wait("Ctrl+E opens the dialog", lambda: window.others())[0]
    run("xdotool", "windowfocus", found)
    wait("the dialog has its list", lambda: window.find("combo box", "Format") or window.find("button", "Format"))
    return found


def press(window, name):
    wait(f"{name} can be pressed", lambda: sensitive(window, name))
    window.get("button", name).do_action(0)


def sensitive(window, name):
    node = window.find("button", name)
    return node and node.get_state_set().contains(Atspi.StateType.SENSITIVE)


def choose(window, found, steps):
    """Goes down the list of kinds by so many steps from its top."""
    run("xdotool", "windowfocus", found)
    node = window.find("combo box", "Format") or window.find("button", "Format")
    box = node.get_extents(Atspi.CoordType.WINDOW)
    run("xdotool", "mousemove", "--window", found, box.x + box.width // 2, box.y + box.height // 2, "click", 1)
    wait("the list unfolds", lambda: window.shows("Numbered images"))
    run("xdotool", "key", "Home", *["Down"] * steps, "Return")


def save_as(window, found, name):
    """Names the file in the chooser that Export… opens."""
    press(window, "Export…")
    chooser = wait("the file chooser opens", lambda: [w for w in window.others() if w != found])[0]
    run("xdotool", "windowfocus", chooser)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--delay", "2", "--", os.path.join(out, name))
    run("xdotool", "key", "Return")
    wait("the file chooser goes", lambda: chooser not in window.others())


def texts(path):
    """The text chunks of a PNG."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        fail(f"{path} is a PNG")
    found, at = {}, 8
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        if zlib.crc32(kind + body) != struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0]:
            fail(f"the chunks of {path} are whole")
        if kind == b"iTXt":
            keyword, rest = body.split(b"\0", 1)
            found[keyword.decode()] = rest[2:].split(b"\0", 2)[2].decode()
        at += 12 + length
    return found


def size(path):
    with open(path, "rb") as file:
        return struct.unpack(">II", file.read(24)[16:])


def unfold(window, dialog, name, entry):
    """Clicks a list until it shows this entry: a dialog that is still being laid out may move under the pointer."""
    for _ in range(6):
        box = (window.find("combo box", name) or window.find("button", name)).get_extents(Atspi.CoordType.WINDOW)
        run("xdotool", "mousemove", "--window", dialog, box.x + box.width // 2, box.y + box.height // 2, "click", 1)
        end = time.monotonic() + 5
        while time.monotonic() < end:
            if window.shows(entry):
                return
            time.sleep(0.05)
    fail(f"{name} unfolds")


def test_export():
    os.mkdir(out)
    path = os.path.join(folder, "curl.dae")
    shutil.copy(os.path.join(configs, "curl.dae"), path)
    window = Window(path)
    wait("the clip is open", lambda: window.get("slider", "Time").get_maximum_value() > 1)

    found = dialog(window)
    wait("one picture is offered", lambda: window.shows("One image of"))
    save_as(window, found, "one.png")
    wait("the picture is there", lambda: files() == ["one.png"])
    wait("the dialog goes when it is done", lambda: not window.others())
    notes = texts(os.path.join(out, "one.png"))
    if not notes.get("Software", "").startswith("Sinew ") or "curl.dae" not in notes.get("Comment", ""):
        fail(f"the picture says how it was made: {notes}")
    told("the dialog saves a picture that says how it was made")

    found = dialog(window)
    choose(window, found, 3)
    wait("numbered pictures are offered", lambda: window.shows("Frames per second"))
    # Long enough to be stopped: the model turns for an hour.
    unfold(window, found, "Motion", "Elbow flexion")
    run("xdotool", "key", "End", "Return")
    seconds = wait("a turn has a length", lambda: window.find("spin button", "Duration, s") or window.find("text", "Duration, s"))
    seconds.set_current_value(3600.0)
    save_as(window, found, "turn.png")
    wait("the frames are counted", lambda: window.shows("Frame ") and len(files()) > 2)
    press(window, "Cancel")
    wait("the dialog says that it was stopped", lambda: window.shows("Stopped; nothing was written"))
    if files() != ["one.png"]:
        fail(f"nothing is left of what was stopped: {files()}")
    told("Cancel stops an export and leaves nothing")

    seconds.set_current_value(0.2)
    save_as(window, found, "turn.png")
    wait("the pictures are there", lambda: files() == ["one.png"] + [f"turn-{n:04}.png" for n in range(5)])
    wait("the dialog goes when it is done", lambda: not window.others())
    if size(os.path.join(out, "turn-0004.png")) != size(os.path.join(out, "one.png")):
        fail("the pictures have the size that was set")
    if texts(os.path.join(out, "turn-0001.png")) == texts(os.path.join(out, "turn-0002.png")):
        fail("each picture says which it is")
    told("numbered pictures are saved")

    found = dialog(window)
    choose(window, found, 15)
    wait("joint angles are offered", lambda: window.shows("flexion and rotation"))
    save_as(window, found, "joints.csv")
    wait("the table is there", lambda: "joints.csv" in files())
    wait("the dialog goes when it is done", lambda: not window.others())
    command = subprocess.run([window.process.args[0], "measure", path, "--joints", "--csv"], check=True, stdout=subprocess.PIPE)
    with open(os.path.join(out, "joints.csv"), "rb") as file:
        if file.read() != command.stdout:
            fail("the table is the one that the command line makes")
    told("the table of joints is that of the command line")

    # F12 asks for a name at once.
    run("xdotool", "mousemove", 500, 300, "click", 1)
    window.key("F12")
    chooser = wait("F12 asks for a name", lambda: window.others())[0]
    run("xdotool", "windowfocus", chooser)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--delay", "2", "--", os.path.join(out, "shot.png"))
    run("xdotool", "key", "Return")
    wait("the picture is there", lambda: "shot.png" in files())
    if "curl.dae" not in texts(os.path.join(out, "shot.png")).get("Comment", ""):
        fail("F12's picture says how it was made")
    told("F12 saves a picture that says how it was made")

    before = files()
    found = dialog(window)
    choose(window, found, 1)
    window.find("spin button", "Width, pixels").set_current_value(4000.0)
    window.find("spin button", "Height, pixels").set_current_value(4000.0)
    save_as(window, found, "film.gif")
    wait("the film has begun", lambda: len(files()) > len(before))
    os.kill(window.process.pid, signal.SIGTERM)
    wait("the program ends when it is told to", lambda: window.process.poll() is not None)
    if window.process.returncode != 130:
        fail(f"it ends with 130 then, not {window.process.returncode}: {window.process.stderr.read()}")
    if files() != before:
        fail(f"nothing is left of what was stopped: {files()}")
    told("a program that is ended leaves no half film")


test_export()
print("all is so")
