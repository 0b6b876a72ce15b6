"""Takes pictures of the main views in both languages and both styles, for people to look at: shots.py PROGRAM FOLDER CONFIGS; they go to the folder that
SINEW_SHOTS names. Asks only that each view comes up without a critical message."""

import os

from drive import Window, configs, run, told
from drive_hands import page

TO = os.environ.get("SINEW_SHOTS", "out/shots")
SIZE = 1280, 860
LANGUAGES = {"en": "C.UTF-8", "ru": "ru_RU.UTF-8"}
STYLES = {"light": "Adwaita", "dark": "Adwaita:dark"}
# View: files, name of the right-hand page in both languages, keys.
VIEWS = {
    "start": ((), None, ("alt+Home",)),
    "muscle": (("biceps.yaml",), ("Muscle", "Мышца"), ("alt+Up",) * 8),
    "clip": (("walker.dae",), ("Display", "Отображение"), ("space",)),
    "bones": (("walker.dae",), ("Display", "Отображение"), ("b", "j", "h")),
    "measure": (("biceps-human-wrapped.yaml",), ("Measure", "Измерения"), ("alt+Right",) * 12),
    "health": (("lamp.dae",), ("Diagnostics", "Диагностика"), ("3",)),
    "curves": (("curl.dae", "atlas-muscles.yaml"), ("Muscle", "Мышца"), ("shift+k",)),
    "keys": (("lamp.dae",), None, ("ctrl+question",)),
}


def shoot(view, language, style):
    files, names, keys = VIEWS[view]
    os.environ.update(LANG=LANGUAGES[language], LC_ALL=LANGUAGES[language], LANGUAGE=language, GTK_THEME=STYLES[style])
    window = Window(*(os.path.join(configs, name) for name in files), flat=False)
    run("xdotool", "windowsize", window.window, *SIZE)
    if names:
        page(window, *names)
    # The picture has the keys; the pointer rests where it covers nothing.
    run("xdotool", "mousemove", SIZE[0] // 2, 90, "sleep", 0.3, "click", 1)
    for key in keys:
        window.key(key)
    run("xdotool", "mousemove", SIZE[0] // 2, SIZE[1] + 20, "sleep", 1.5)
    run("import", "-window", "root", "-crop", f"{SIZE[0]}x{SIZE[1]}+0+0", os.path.join(TO, f"{view}-{language}-{style}.png"))
    window.process.terminate()
    for line in window.process.communicate()[1].splitlines():
        if "CRITICAL" in line or "panicked" in line:
            raise SystemExit(f"NOT SO: {view}, {language}, {style}: {line}")


os.makedirs(TO, exist_ok=True)
for view in VIEWS:
    for language in LANGUAGES:
        for style in STYLES:
            shoot(view, language, style)
    told(f"{view} is pictured")
print("all is so")
