"""Draws the yardstick of `sinew bench` with Mesa's llvmpipe and sets both side by side.

The scene is described in src/render/bench/mod.rs: a sphere of radius 1, one far light, back faces left out, 1280 × 720. llvmpipe gets positions and
normals anew each frame, as a program that skins on the processor would send them, and the finished picture is copied to memory.

    python3 benches/peers/llvmpipe.py target/release/sinew      (needs moderngl and numpy; `make bench` makes an environment with both)
"""

import json
import math
import os
import statistics
import subprocess
import sys
import time

os.environ.update(EGL_PLATFORM="surfaceless", LIBGL_ALWAYS_SOFTWARE="1")
os.environ.setdefault("LP_NUM_THREADS", str(os.cpu_count()))

import moderngl  # noqa: E402 (Mesa reads its variables when it is loaded)
import numpy as np  # noqa: E402

SIZE = (1280, 720)
SPHERES = {"sphere-10k": (100, 51), "sphere-100k": (316, 159)}
VIEWS = {"fill": 2.6, "figure": 5.0}
SECONDS, FRAMES = 2.0, 400

VERTEX = """
#version 330
uniform mat4 turn;
uniform mat4 clip;
uniform vec3 towards_light;
in vec3 position;
in vec3 normal;
out vec3 color;
void main() {
    vec4 world = turn * vec4(position, 1.0);
    gl_Position = clip * world;
    float light = 0.15 + 0.85 * max(dot(mat3(turn) * normal, towards_light), 0.0);
    color = vec3(0.9, 0.6, 0.5) * light;
}
"""
FRAGMENT = """
#version 330
in vec3 color;
out vec4 pixel;
void main() { pixel = vec4(color, 1.0); }
"""


def sphere(segments, rings):
    """Positions (which are the normals too) and triangles, outside anticlockwise."""
    polar = np.linspace(0.0, math.pi, rings + 1)[:, None]
    round_ = np.linspace(0.0, 2.0 * math.pi, segments + 1)[None, :]
    points = np.stack([np.sin(polar) * np.sin(round_), np.cos(polar) + 0.0 * round_, np.sin(polar) * np.cos(round_)], axis=-1)
    corner = np.arange(rings + 1)[:, None] * (segments + 1) + np.arange(segments + 1)[None, :]
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    lower = np.stack([a, b, c], axis=-1)[:-1].reshape(-1, 3)
    upper = np.stack([a, c, d], axis=-1)[1:].reshape(-1, 3)
    return points.reshape(-1, 3).astype("f4"), np.concatenate([lower, upper]).astype("u4")


def matrices(angle, distance):
    sin, cos = math.sin(angle), math.cos(angle)
    turn = np.array([[cos, 0, sin, 0], [0, 1, 0, 0], [-sin, 0, cos, 0], [0, 0, 0, 1]], "f4")
    focus, near, far = 1.0 / math.tan(math.radians(22.5)), 0.1, 100.0
    project = np.array([[focus * SIZE[1] / SIZE[0], 0, 0, 0], [0, focus, 0, 0],
                        [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]], "f4")
    move = np.eye(4, dtype="f4")
    move[2, 3] = -distance
    # OpenGL takes columns.
    return turn.T.tobytes(), (project @ move).T.astype("f4").tobytes()


def median(frame):
    for warm in range(5):
        frame(warm)
    times, begin = [], time.perf_counter()
    while len(times) < 10 or (len(times) < FRAMES and time.perf_counter() - begin < SECONDS):
        start = time.perf_counter()
        frame(len(times))
        times.append((time.perf_counter() - start) * 1e3)
    return statistics.median(times)


def llvmpipe():
    """Median milliseconds and lit pixels by (scene, view)."""
    context = moderngl.create_context(standalone=True, backend="egl")
    if "llvmpipe" not in context.info["GL_RENDERER"]:
        sys.exit(f"this is {context.info['GL_RENDERER']}, not llvmpipe")
    print(f"{context.info['GL_RENDERER']}, Mesa {context.info['GL_VERSION'].split('Mesa ')[-1]}, {os.environ['LP_NUM_THREADS']} threads")
    program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
    light = np.array([0.4, 0.6, 0.7])
    program["towards_light"].value = tuple(light / np.linalg.norm(light))
    target = context.framebuffer([context.renderbuffer(SIZE, 4)], context.depth_renderbuffer(SIZE))
    target.use()
    context.enable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
    picture, found = bytearray(SIZE[0] * SIZE[1] * 4), {}
    for scene, (segments, rings) in SPHERES.items():
        points, triangles = sphere(segments, rings)
        upload = np.concatenate([points, points], axis=1).tobytes()
        buffer = context.buffer(upload)
        array = context.vertex_array(program, [(buffer, "3f 3f", "position", "normal")], context.buffer(triangles.tobytes()))
        for view, distance in VIEWS.items():
            def frame(number):
                buffer.orphan()
                buffer.write(upload)
                turn, clip = matrices(number * 0.01, distance)
                program["turn"].write(turn)
                program["clip"].write(clip)
                target.clear()
                array.render()
                target.read_into(picture, components=4)

            took = median(frame)
            found[scene, view] = took, int(np.count_nonzero(np.frombuffer(picture, "u4")))
    return found


def main():
    peer = llvmpipe()
    call = [sys.argv[1], "bench", "--json", "--seconds", str(SECONDS), "--scene", "sphere-10"]
    ours = json.loads(subprocess.run(call, check=True, capture_output=True, text=True).stdout)
    print(f"sinew: {ours['simd']}, {ours['threads']} threads\n")
    print(f"{'scene':24}{'llvmpipe, ms':>14}{'sinew, ms':>12}{'ratio':>8}   lit pixels of both")
    for scene in ours["scenes"]:
        key = scene["scene"], scene["view"]
        if key in peer and scene["shading"] == "gouraud" and scene["samples"] == 1:
            took, lit = peer[key]
            print(f"{' '.join(key):24}{took:14.2f}{scene['median_ms']:12.2f}{took / scene['median_ms']:7.1f}×   {lit} {scene['lit_pixels']}")


main()
