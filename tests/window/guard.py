"""Saves onto what is open, as a person may by mistake: it is refused, told, and nothing is lost. Run as drive.py is, whose hands it uses."""

import os
import shutil

from drive import Window, configs, fail, folder, run, told, wait, write


def at(name):
    return os.path.join(folder, name)


def held(*names):
    """What these files hold, and a check that they still do."""
    before = {}
    for name in names:
        with open(at(name), "rb") as file:
            before[name] = file.read()

    def check(when):
        for name, text in before.items():
            with open(at(name), "rb") as file:
                if file.read() != text:
                    fail(f"{name} is what it was after {when}")

    return check


def begin(window, key):
    """The chooser that a key opens."""
    run("xdotool", "mousemove", 500, 300, "click", 1)
    run("xdotool", "windowfocus", window.window)
    window.key(key)
    chooser = wait(f"{key} asks for a name", lambda: window.others())[0]
    run("xdotool", "windowfocus", chooser)
    return chooser


def end(window, chooser):
    wait("the chooser goes", lambda: chooser not in window.others())
    run("xdotool", "windowfocus", window.window)


def save(window, key, name, there, replace=True):
    """Names a file in the chooser that a key opens; where one is there of the name that it will have, the chooser's own question is answered."""
    chooser = begin(window, key)
    run("xdotool", "key", "ctrl+a")
    run("xdotool", "type", "--delay", "2", "--", at(name))
    run("xdotool", "key", "Return")
    if there:
        # The chooser's question is in no tree; Replace is what Return means.
        question = wait("the chooser asks whether to replace it", lambda: [other for other in window.others() if other != chooser])[0]
        run("xdotool", "windowfocus", question)
        run("xdotool", "key", "Return" if replace else "Escape")
        if not replace:
            wait("the question goes", lambda: question not in window.others())
            run("xdotool", "windowfocus", chooser)
            run("xdotool", "key", "Escape")
    end(window, chooser)


def refused(window, name):
    wait(f"{name} could not be saved", lambda: window.shows(f"{name} could not be saved"))
    wait("the reason is told", lambda: window.shows("a result never replaces it"))


for name in ("curl.dae", "curl-muscles.yaml", "walker.dae", "walker.png"):
    shutil.copy(os.path.join(configs, name), at(name))
os.symlink("curl.dae", at("soft.png"))
os.link(at("curl-muscles.yaml"), at("hard.yaml"))
check = held("curl.dae", "curl-muscles.yaml", "walker.dae", "walker.png")

window = Window(at("curl-muscles.yaml"))
save(window, "F12", "soft.png", True)
refused(window, "soft.png")
check("F12 onto a link to the clip")
told("F12 does not replace the clip through a link, whatever the chooser was answered")

save(window, "F12", "curl.dae", False)
wait("the picture has an ending of its own", lambda: os.path.isfile(at("curl.dae.png")))
wait("its name is told", lambda: window.shows("curl.dae.png"))
check("F12 onto the clip")
told("F12 onto curl.dae makes curl.dae.png, says so, and asks nothing about curl.dae")

write("plain.png", "kept")
save(window, "F12", "plain", True, replace=False)
if open(at("plain.png")).read() != "kept":
    fail("Cancel keeps plain.png")
save(window, "F12", "plain", True)
wait("Replace replaces it", lambda: open(at("plain.png"), "rb").read(4) == b"\x89PNG")
told("a name that is completed is asked about as it will be, and once")

for name in ("curl-muscles.yaml", "hard.yaml"):
    save(window, "ctrl+alt+s", name, True)
    refused(window, name)
    check(f"Ctrl+Alt+S onto {name}")
told("Ctrl+Alt+S does not replace the muscle file, by no name")

save(window, "ctrl+alt+s", "look", False)
wait("the session is saved", lambda: os.path.isfile(at("look.yaml")))
wait("the message goes", lambda: not window.shows("could not be saved"))
save(window, "ctrl+alt+s", "look.yaml", True)
wait("its own file may be replaced", lambda: window.shows("look.yaml"))
if window.shows("could not be saved"):
    fail("a session replaces its own file")
session = held("look.yaml")
save(window, "ctrl+shift+s", "look.yaml", True)
refused(window, "look.yaml")
session("Ctrl+Shift+S onto the session file")
told("a session replaces its own file, and muscles do not")
window.quit()

window = Window(at("look.yaml"))
for key, name in (("ctrl+shift+s", "look.yaml"), ("ctrl+alt+s", "curl-muscles.yaml")):
    save(window, key, name, True)
    refused(window, name)
    session(f"{key} onto {name}")
    check(f"{key} onto {name}")
told("what a session opens is open, and so is the session file")
window.quit()

os.link(at("walker.png"), at("skin.png"))
window = Window(at("walker.dae"))
for name in ("walker.png", "skin.png"):
    save(window, "F12", name, True)
    refused(window, name)
    check(f"F12 onto {name}")
told("F12 does not replace a texture")
for name in ("walker-1.png", "walker-2.png"):
    chooser = begin(window, "F12")
    run("xdotool", "key", "Return")
    end(window, chooser)
    wait(f"{name} is saved", lambda: os.path.isfile(at(name)) and window.shows(name))
    check("F12 and Return")
told("the name that F12 proposes is free, and no clip's own texture")
window.quit()

shutil.copy(os.path.join(configs, "lamp.dae"), at("lamp.dae"))
write("beside.yaml", "sinew_session:\n  files: [lamp.dae]\n  compared: {file: walker.dae}\n")
window = Window(at("beside.yaml"))
for name in ("walker.png", "skin.png"):
    save(window, "F12", name, True)
    refused(window, name)
    check(f"F12 onto {name}")
told("F12 does not replace a texture of what is compared with")
window.quit()
if any(name.startswith(".sinew") for name in os.listdir(folder)):
    fail("no temporary file stays")
print("all is so")
