"""What a person may trust: undo, keys, boxes of numbers, sizes, toasts, what outlives a crash, memory. Run as drive.py is."""

import os
import signal
import subprocess
import time

from drive import CLIP, Atspi, Window, configs, fail, folder, pressed, run, still, told, value, wait, walk, write
from drive_hands import enter, named
from hands import at, click, focus_picture


def text_of(node):
    return Atspi.Text.get_text(node, 0, Atspi.Text.get_character_count(node))


def held_in(window):
    """How often the window says that the elbow is held, and where."""
    return [node.get_name() for node in walk(window.root) if node.get_role_name() == "label" and node.get_name().startswith("Elbow held at")]


def test_undo():
    """The elbow of a clip, bent by the slider."""
    window = Window(os.path.join(configs, "curl.dae"))
    click(*at(window.get("page tab", "Muscle")))
    elbow = window.get("slider", "Elbow angle")
    wait("the elbow can be bent", lambda: elbow.get_maximum_value() > 100.0)
    free = value(elbow)
    undo, redo = window.get("button", "Undo"), window.get("button", "Redo")
    sensitive = lambda node: node.get_state_set().contains(Atspi.StateType.SENSITIVE)
    elbow.set_current_value(107.0)
    wait("it is said in the picture and on the timeline that it is held", lambda: held_in(window) == ["Elbow held at 107°"] * 2)
    wait("bending can be undone", lambda: sensitive(undo))
    focus_picture()
    window.key("ctrl+z")
    wait("Undo gives the elbow back", lambda: abs(value(elbow) - free) < 1e-6 and not window.shows("Elbow held at"))
    # The same value at once: a step of its own.
    elbow.set_current_value(60.0)
    wait("there is nothing to do again any more", lambda: not sensitive(redo))
    wait("what came after an undo can be undone", lambda: sensitive(undo))
    window.key("ctrl+z")
    wait("and is", lambda: abs(value(elbow) - free) < 1e-6)
    window.key("ctrl+shift+z")
    wait("and done again", lambda: abs(value(elbow) - 60.0) < 1e-6)
    window.key("space")
    wait("the clip plays", lambda: pressed(window.get("button", "Play")))
    wait("it is said that the elbow stands still", lambda: window.shows("Elbow held at 60°"))
    window.key("space")
    click(*at(next(node for node in walk(window.root) if node.get_name() == "Release" and at(node)[1] < 200)))
    wait("Release gives it back", lambda: not window.shows("Elbow held at"))
    window.key("ctrl+z")
    wait("which is undone too", lambda: abs(value(elbow) - 60.0) < 1e-6)
    told("bending by the slider is undone and done again, and a joint that is held is told and released")
    window.quit()


def test_boxes():
    window = Window(write("boxes.dae", CLIP))
    slider = window.get("slider", "Time")
    frame = window.get("spin button", "Frame number")
    seconds = window.get("spin button", "Exact time, seconds")
    focus = lambda node: node.get_state_set().contains(Atspi.StateType.FOCUSED) or any(map(focus, children(node)))
    children = lambda node: [node.get_child_at_index(index) for index in range(node.get_child_count())]
    for box, typed, reads in ((frame, "17", "17"), (seconds, "0.5", "0.500")):
        click(*at(box, 0.2))
        window.key("ctrl+a")
        run("xdotool", "type", "--", typed)
        window.key("Return")
        wait(f"{typed} is taken", lambda: text_of(box) == reads)
        edges = pressed(window.get("check box", "Wireframe"))
        window.key("e")
        wait("after Enter a letter is a command", lambda: pressed(window.get("check box", "Wireframe")) != edges)
        if text_of(box) != reads:
            fail(f"the box takes the letter: {text_of(box)}")
    at_half = value(slider)
    click(*at(frame, 0.2))
    window.key("ctrl+a")
    run("xdotool", "type", "--", "3e")
    wait("no letter comes into the box", lambda: text_of(frame) == "3")
    window.key("Escape")
    wait("Esc shows what was there", lambda: text_of(frame) != "3")
    if abs(value(slider) - at_half) > 1e-6:
        fail("Esc takes nothing")
    window.key("shift+Right")
    wait("after Esc keys go to the picture", lambda: abs(value(slider) - 2.0) < 1e-6)
    told("boxes of numbers give the keyboard back and take no letters")
    click(600, 330)
    slider.set_current_value(0.0)
    wait("a click selects", lambda: window.count("Node") > 1)
    window.key("Escape")
    wait("Esc takes the selection away", lambda: window.count("Node") == 1)
    told("Esc takes the selection away")
    window.quit()


def test_size():
    sizes = []
    for _ in range(4):
        window = Window(write("size.dae", CLIP))
        if not sizes:
            run("xdotool", "windowsize", "--sync", window.window, 1111, 777)
            wait("the window follows", lambda: "WIDTH=1111" in run("xdotool", "getwindowgeometry", "--shell", window.window).decode())
        sizes.append([line for line in run("xdotool", "getwindowgeometry", "--shell", window.window).decode().split() if line[:1] in "WH"][-2:])
        window.quit()
    if any(size != sizes[0] for size in sizes):
        fail(f"the size of the window survives its starts: {sizes}")
    told("the size of the window survives any number of starts")


def test_toast():
    one, two = write("toast-a.dae", CLIP), write("toast-b.dae", CLIP)
    window = Window(one)
    focus_picture()
    window.key("F5")
    shown = lambda: window.shows("Reloaded:")
    wait("a toast says that the file was read again", shown)
    window.key("ctrl+Next")
    wait("the next file is open", lambda: os.path.basename(two) in run("xdotool", "getwindowname", window.window).decode())
    wait("the toast went with the scene that it was about", lambda: not shown())
    told("a toast does not outlive its scene")
    window.quit()


def test_crash():
    """A program that is killed at once after an edit and is not even buried: what it left is offered by the next one."""
    state = os.path.join(os.environ["XDG_STATE_HOME"], "sinew")
    window = Window(os.path.join(configs, "biceps.yaml"))
    wait("there is a length", lambda: named(window, "Rest length L₀"))
    enter(named(window, "Rest length L₀")[0], "123.5")
    left = lambda: [name for name in os.listdir(state) if name.endswith(".yaml")] if os.path.isdir(state) else []
    wait("what is not saved is written down", left)
    window.process.send_signal(signal.SIGKILL)
    again = Window()
    restore = again.get("button", "Restore")
    click(*at(restore))
    wait("it is back", lambda: run("xdotool", "getwindowname", again.window).decode().startswith("•"))
    window.process.wait()
    again.key("ctrl+z")
    wait("undo takes it away again", lambda: not run("xdotool", "getwindowname", again.window).decode().startswith("•"))
    again.quit()
    if os.listdir(state):
        fail(f"nothing is left behind: {os.listdir(state)}")
    told("what was not saved is offered however soon the next start comes")


def test_reloading():
    window = Window(os.path.join(configs, "walker.dae"))
    window.get("slider", "Time")
    focus_picture()

    def reloaded(times):
        for _ in range(times):
            window.key("F5")
            wait("the file is read", lambda: window.shows("Reloaded:"))
        still(window)
        with open(f"/proc/{window.process.pid}/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))

    warm, now = reloaded(40), reloaded(120)
    if now > warm * 1.08 + 4096:
        fail(f"memory is flat while a file is read again: {warm} -> {now} KiB")
    told(f"160 times F5: {warm} -> {now} KiB")
    window.quit()


def start_with(what, **environment):
    """Starts without the accessibility tree, which may not be there; the window is found by its name."""
    process = subprocess.Popen([__import__("drive").program], stderr=subprocess.PIPE, text=True, env={**os.environ, **environment})
    there = lambda: process.poll() is not None or subprocess.run(["xdotool", "search", "--onlyvisible", "--pid", str(process.pid)], stdout=subprocess.PIPE).stdout
    wait(f"{what}: the window comes, or the program says why not", there)
    ended = process.poll()
    if ended is None:
        process.terminate()
        process.wait(20)
    said = process.stderr.read()
    if "panicked" in said or ended not in (None, 0, 1):
        fail(f"{what}: {ended}, {said}")
    if ended == 1 and len(said.strip().splitlines()) != 1:
        fail(f"{what}: one sentence says why: {said}")
    return said


def test_starts():
    start_with("no session bus", DBUS_SESSION_BUS_ADDRESS="unix:path=/nonexistent")
    start_with("a broken accessibility bus", AT_SPI_BUS_ADDRESS="unix:path=/nonexistent")
    fonts = write("fonts.conf", '<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd"><fontconfig></fontconfig>')
    said = start_with("no fonts", FONTCONFIG_FILE=fonts)
    if "font" not in said:
        fail(f"it is said that there are no fonts: {said}")
    home = os.path.join(folder, "pipe")
    os.makedirs(os.path.join(home, "sinew"))
    os.mkfifo(os.path.join(home, "sinew", "settings.yaml"))
    start_with("settings that are a pipe", XDG_CONFIG_HOME=home)
    endless = os.path.join(folder, "endless")
    os.makedirs(os.path.join(endless, "sinew"))
    os.symlink("/dev/zero", os.path.join(endless, "sinew", "settings.yaml"))
    start_with("settings without an end", XDG_CONFIG_HOME=endless)
    told("it starts without buses, with settings that are no file, and says that there are no fonts")


def test_box_without_clip():
    """A box that has the keyboard loses its clip: its cursor is not left blinking, of which GTK would complain a moment later."""
    window = Window(write("closed.dae", CLIP))
    box = window.get("spin button", "Exact time, seconds")
    click(*at(box, 0.2))
    wait("the box has the keyboard", lambda: box.get_state_set().contains(Atspi.StateType.FOCUSED))
    window.key("ctrl+w")
    wait("there is no time any more", lambda: not box.get_state_set().contains(Atspi.StateType.SENSITIVE))
    time.sleep(2)  # a cursor blinks every 1.2 s
    window.quit()
    told("a box that loses its clip loses the keyboard")


if __name__ == "__main__":
    test_box_without_clip()
    test_undo()
    test_boxes()
    test_toast()
    test_crash()
    test_reloading()
    test_starts()
    test_size()
    print("all is so")
