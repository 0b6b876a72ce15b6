"""Presses every key of the window that no other driver presses, with a window manager where there is one; see drive.py, whose hands these are.

usage: bindings.py PROGRAM FOLDER CONFIGS
"""

import os
import shutil
import subprocess

from drive import CLIP, Window, fail, folder, open_arm, pressed, run, still, told, value, wait
from hands import changes, click, drag, focus_picture

# Two clips of one node, so that there is something to choose from.
CLIPS = CLIP.replace(
    "</library_animations>",
    "</library_animations><library_animation_clips>"
    + "".join(f'<animation_clip id="{name}" start="0" end="{end}"><instance_animation url="#turn"/></animation_clip>' for name, end in (("short", 1), ("long", 2)))
    + "</library_animation_clips>",
)


def write(path, text):
    with open(path + ".new", "w") as file:
        file.write(text)
    os.replace(path + ".new", path)


def at_time(slider, what, seconds):
    wait(what, lambda: abs(value(slider) - seconds) < 1e-6)


def titled(window, text):
    return text in run("xdotool", "getwindowname", window.window).decode()


def test_time(window, slider):
    play, speed = window.get("button", "Play"), window.get("spin button", "Speed; negative plays backwards")
    slider.set_current_value(0.25)
    window.key("ctrl+Right")
    at_time(slider, "Ctrl+Right goes a second on", 1.25)
    window.key("ctrl+Left")
    at_time(slider, "Ctrl+Left goes a second back", 0.25)
    window.key("shift+Left")
    at_time(slider, "Shift+Left goes to the start", 0.0)
    window.key("Down")
    at_time(slider, "Down goes to the next key", 1.0)
    for key, what, expected in (("bracketright", "] is faster", 1.0), ("backslash", "\\ is as recorded", 0.0), ("bracketleft", "[ is slower", -1.0)):
        window.key(key)
        wait(what, lambda: (value(speed) - 1.0) * expected > 0.0 if expected else value(speed) == 1.0)
    window.key("backslash")
    slider.set_current_value(1.5)
    window.key("ctrl+shift+space")
    wait("Ctrl+Shift+Space turns time round", lambda: value(speed) < 0.0)
    window.key("ctrl+shift+space")
    wait("and back", lambda: value(speed) == 1.0)
    if pressed(play):
        window.key("space")
        wait("Space stops", lambda: not pressed(play))
    told("keys of time: seconds, first, key, slower, faster, recorded speed, reverse")

    loop = window.get("button", "Repeat mode")
    seen = [loop.get_description()]
    for _ in range(3):
        window.key("l")
        wait("L changes what happens at the end", lambda: loop.get_description() != seen[-1])
        seen.append(loop.get_description())
    if len(set(seen)) != 3 or seen[0] != seen[3]:
        fail(f"L goes through three ways to end: {seen}")
    told("L goes through loop, once and ping-pong")

    slider.set_current_value(0.5)
    window.key("i")
    slider.set_current_value(1.0)
    window.key("o")
    slider.set_current_value(0.6)
    window.key("space")
    times = []
    wait("playing turns at the mark of O", lambda: times.append(value(slider)) or (len(times) > 3 and times[-1] < times[-2]))
    window.key("space")
    wait("Space stops", lambda: not pressed(play))
    if min(times) < 0.5 - 1e-6 or max(times) > 1.0 + 1e-6:
        fail(f"playing left the marks of I and O: {min(times)} to {max(times)}")
    told("I and O bound what plays")


def test_clips_and_files(window, slider):
    long = abs(slider.get_maximum_value() - 2.0) < 1e-6
    ends = lambda long: wait("the clip is there", lambda: abs(slider.get_maximum_value() - (2.0 if long else 1.0)) < 1e-6)
    forth, back = ("Page_Up", "Page_Down") if long else ("Page_Down", "Page_Up")
    window.key(forth)
    ends(not long)
    window.key(back)
    ends(long)
    told("PgUp and PgDn change the clip")
    window.key("ctrl+Page_Down")
    wait("Ctrl+PgDn opens the next file of the folder", lambda: titled(window, "two.dae"))
    window.key("ctrl+Page_Up")
    wait("Ctrl+PgUp opens the one before", lambda: titled(window, "one.dae"))
    told("Ctrl+PgUp and Ctrl+PgDn step through the folder")


def test_switches(window):
    for key, name in (("b", "Bones"), ("j", "Bone names"), ("n", "Smooth normals"), ("shift+n", "Show normals"), ("t", "Materials and textures"),
                      ("e", "Wireframe"), ("c", "Ground grid"), ("x", "World axes"), ("m", "Muscles"), ("h", "Onion skins")):
        box = window.get("check box", name)
        before = pressed(box)
        window.key(key)
        wait(f"{key} switches: {name}", lambda: pressed(box) != before)
        window.key(key)
        wait(f"{key} switches back: {name}", lambda: pressed(box) == before)
    told("keys of what is shown: B J N Shift+N T E C X M H")


def test_flight(window):
    start = still(window)
    window.key("shift+grave")
    changes(window, "Shift+` takes off, E rises", lambda: run("xdotool", "keydown", "e", "sleep", 0.3, "keyup", "e"))
    changes(window, "Q sinks", lambda: run("xdotool", "keydown", "q", "sleep", 0.3, "keyup", "q"))
    changes(window, "S goes back", lambda: run("xdotool", "keydown", "s", "sleep", 0.3, "keyup", "s"))
    for key in ("a", "d"):
        changes(window, f"{key} goes aside", lambda: run("xdotool", "keydown", key, "sleep", 0.2, "keyup", key))
    for held in ("shift", "alt"):
        changes(window, f"with {held} it flies at another speed", lambda: run("xdotool", "keydown", held, "keydown", "w", "sleep", 0.2, "keyup", "w", "keyup", held))
    window.key("Escape")
    window.key("Return")
    wait("Enter brings the camera back", lambda: window.picture() == start)
    told("flight: Shift+`, W A S D, Q E, with Shift and Alt")


def test_centre(window):
    window.key("9")
    still(window)
    changes(window, "a double click centres what it hits", lambda: run("xdotool", "mousemove", 640, 380, "click", "--repeat", 2, "--delay", 60, 1))
    window.key("Home")
    changes(window, "a pan moves the plate away", lambda: drag(600, 330, 660, 360, held="shift"))
    changes(window, ". centres the selection", lambda: window.key("period"))
    window.key("Return")
    click(350, 150)
    still(window)
    changes(window, "the middle button orbits", lambda: drag(600, 330, 650, 350, button=2))
    changes(window, "Ctrl and a drag zoom", lambda: drag(600, 330, 600, 380, held="ctrl"))
    window.key("Return")
    told("double click, point, middle button, Ctrl and a drag")


def test_panels(window):
    shown = lambda name: pressed(window.get("button", name))
    before = shown("Scene tree"), shown("Right panel")
    window.key("F9")
    wait("F9 folds both panels away", lambda: not shown("Scene tree") and not shown("Right panel"))
    window.key("F9")
    wait("and brings them back", lambda: (shown("Scene tree"), shown("Right panel")) == before)
    for key, words in (("F1", "Problems"), ("ctrl+question", "Both side panels")):
        window.key(key)
        other = wait(f"{key} shows a window", lambda: window.others())[0]
        wait(f"{key} shows: {words}", lambda: window.shows(words))
        run("xdotool", "windowfocus", other)
        window.key("Escape")
        wait("Esc closes them", lambda: not window.others())
        run("xdotool", "windowfocus", window.window)
    if window.find("menu item", "Keyboard shortcuts"):
        fail("the menu is closed before F10")
    window.key("F10")
    wait("F10 opens the menu", lambda: window.find("menu item", "Keyboard shortcuts"))
    window.key("Escape")
    told("F9, F1 with the help, Ctrl+? with the keys, F10")


def test_pictures(window):
    window.key("ctrl+c")
    wait("Ctrl+C copies the picture", lambda: window.shows("The image is copied"))
    told("Ctrl+C copies")
    for key in ("F12", "ctrl+F12"):
        path = os.path.join(folder, f"{key}.png")
        window.key(key)
        dialog = wait(f"{key} asks for a name", lambda: window.others())[0]
        run("xdotool", "windowfocus", dialog)
        run("xdotool", "key", "ctrl+a")
        run("xdotool", "type", "--", path)
        run("xdotool", "key", "Return")
        wait(f"{key} writes the picture", lambda: os.path.getsize(path) > 0)
        run("xdotool", "windowfocus", window.window)
        wait("the window has the keyboard again", lambda: not window.others())
        wait("what was saved is told", lambda: window.shows(f"Saved {os.path.basename(path)}"))
        corner = subprocess.run(["convert", path, "-format", "%[fx:p{2,2}.a]", "info:"], check=True, stdout=subprocess.PIPE, text=True).stdout
        if (float(corner) == 0.0) != (key == "ctrl+F12"):
            fail(f"{key}: the opacity of the corner is {corner}")
    told("F12 and Ctrl+F12 save the picture, the second without background")


def test_watching(window, slider, path):
    """An exporter writes the file again: time, camera and switches stay."""
    window.key("x")
    axes = window.get("check box", "World axes")
    wait("axes are on", lambda: pressed(axes))
    slider.set_current_value(0.75)
    window.key("3")
    before = still(window)
    write(path, CLIPS.replace('start="0" end="2"', 'start="0" end="1.5"').replace('name="Plate"', 'name="Board"'))
    wait("the clip written anew is read", lambda: abs(slider.get_maximum_value() - 1.5) < 1e-6 or abs(slider.get_maximum_value() - 1.0) < 1e-6)
    if abs(value(slider) - 0.75) > 1e-6 or not pressed(axes):
        fail("time and switches stay when the file is read again")
    wait("the camera stays too", lambda: window.picture() == before)
    window.key("F5")
    wait("F5 reads it again", lambda: abs(value(slider) - 0.75) < 1e-6 and pressed(axes))
    told("a file written anew is read again, with time, camera and switches kept")


def test_muscle():
    window, contraction, elbow = open_arm()
    focus_picture()
    window.key("alt+Right")
    wait("Alt+Right bends the elbow by five degrees", lambda: abs(value(elbow) - 5.0) < 1e-6)
    window.key("alt+Left")
    wait("Alt+Left straightens it", lambda: abs(value(elbow)) < 1e-6)
    window.key("alt+Up", "alt+Up")
    wait("Alt+Up contracts by five per cent", lambda: abs(value(contraction) - 10.0) < 1e-6)
    window.key("alt+Down")
    wait("Alt+Down lets go", lambda: abs(value(contraction) - 5.0) < 1e-6)
    told("Alt and the arrows contract and bend")
    window.quit()


def test_fullscreen(window):
    size = lambda: run("xdotool", "getwindowgeometry", "--shell", window.window).decode()
    before = size()
    window.key("F11")
    wait("F11 fills the screen", lambda: "WIDTH=1400" in size() and "HEIGHT=900" in size())
    window.key("F11")
    wait("F11 again gives the size back", lambda: size() == before)
    told("F11 fills the screen and gives it back")


def main():
    manager = subprocess.Popen(["openbox"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) if shutil.which("openbox") else None
    path = os.path.join(folder, "files", "one.dae")
    os.mkdir(os.path.dirname(path))
    write(path, CLIPS)
    write(os.path.join(folder, "files", "two.dae"), CLIP.replace('name="Node"', 'name="Other"'))
    window = Window(path)
    slider = window.get("slider", "Time")
    wait("the clip is read", lambda: slider.get_maximum_value() > 0.9)
    focus_picture()
    test_clips_and_files(window, slider)
    slider = window.get("slider", "Time")
    if abs(slider.get_maximum_value() - 2.0) > 1e-6:
        window.key("Page_Down")
    wait("the long clip is chosen", lambda: abs(slider.get_maximum_value() - 2.0) < 1e-6)
    test_time(window, slider)
    test_switches(window)
    test_flight(window)
    test_centre(window)
    test_panels(window)
    test_pictures(window)
    if manager:
        test_fullscreen(window)
    focus_picture()
    test_watching(window, slider, path)
    window.quit()
    test_muscle()
    if manager:
        manager.terminate()
    print("all is so")


main()
