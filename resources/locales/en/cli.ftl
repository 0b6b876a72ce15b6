# The command line: help pages.
cli-about =
    Opens skeletal animation clips (COLLADA .dae, .zae) and muscles of constant volume (.yaml) in one scene.
    Without a command it opens the window; without a file, on the built-in biceps.
cli-about-info = Prints what a file contains: nodes, meshes, clips, images, muscles, bounds.
cli-about-check = Reads files and prints diagnostics: each problem with its line and how it was handled.
cli-about-render = Draws an image (.png), an animation (.gif, .apng), a video (.mp4, .webm; needs ffmpeg) or numbered images, without a display.
cli-about-export = Writes the posed surface as .obj (with .mtl), .ply or .stl: world space, metres, Y up, triangles with normals.
cli-about-measure = Measures muscles: length, moment arm, volume and radii at each elbow angle.
cli-about-bench = Measures the speed of the rasterizer on this machine.
cli-about-help = Shows this page, or the page of a command.

cli-heading-usage = Usage:
cli-heading-commands = Commands
cli-heading-arguments = Arguments
cli-heading-options = Options
cli-heading-output = Output
cli-heading-time = Time and pose
cli-heading-view = View
cli-heading-appearance = Appearance
cli-heading-examples = Examples:
cli-word-options = OPTIONS
cli-help-closing = Exit code: 0 = done, 1 = a file could not be used, 2 = the call was wrong. “-” as a file is standard input.

cli-arg-files = Files to open side by side in one scene
cli-arg-file = The file: .dae, .zae or .yaml
cli-arg-measure-files = Files to measure; lengths of several must be in the same unit
cli-arg-check-files = Files to read
cli-arg-render-files = Files to draw, side by side in one scene
cli-arg-command = The command whose help is shown
cli-arg-help = Show this help
cli-arg-version = Show the version
cli-arg-json = Print JSON
cli-arg-render-output = Output file: .png, .gif, .apng, .mp4, .webm, or a pattern such as frame-%04d.png for one image per frame, numbered from 0
cli-arg-export-output = Output file: .obj, .ply or .stl
cli-arg-size = Image size in pixels; default: 1280x720
cli-arg-samples = Samples per pixel: 4 = anti-aliasing (default), 1 = faster
cli-arg-background = Background colour: #rrggbb, #rgb, a name such as white, or none for a transparent image; default: a gradient
cli-arg-threads = Number of worker threads; default: one per core. The image is the same for any number
cli-arg-stats = Print the milliseconds of each rendering stage (median over the frames) to standard error
cli-arg-time = Time in seconds on the time axis of the file; times outside the clip are clamped to its ends. Default: the start of the clip
cli-arg-clip = Clip, by its name, id or number (#2 = the second clip). Default: the first clip, or with --time the clip that contains this time
cli-arg-angle = Elbow angle in degrees, 0 = straight arm; for a clip: angle of the elbow that is detected in its skeleton, or of the joint that a muscle file names
cli-arg-on-top = Add --angle to the movement of the joint in the clip instead of replacing it
cli-arg-contraction = Contraction of the muscle, 0 to 100 percent
cli-arg-from = Start of the animation in seconds; default: the start of the clip
cli-arg-to = End of the animation in seconds, included; default: the end of the clip
cli-arg-fps = Frames per second of an animation, 0.01 to 1000 (.gif: up to 50); default: 25
cli-arg-camera = Camera: orbit has a perspective projection, the others an orthographic one; default: orbit
cli-arg-yaw = Camera azimuth in degrees about the vertical axis: 0 = from the front (+Z), 90 = from the right (+X); default: that of the camera
cli-arg-pitch = Camera elevation in degrees above the horizon, -90 to 90; default: that of the camera
cli-arg-zoom = Magnification relative to the view that fits the whole scene, 0.01 to 100
cli-arg-turntable = Rotate the model by one full turn over the animation
cli-arg-light = Position of the light in world space, metres; default: upper left of the camera
cli-arg-shading = Where lighting is computed: once per triangle (flat), at each vertex (gouraud, the default) or at each pixel (phong)
cli-arg-bones = Draw the bones
cli-arg-wireframe = Draw the edges of the triangles
cli-arg-no-materials = Ignore materials and textures
cli-arg-no-skin-follow = Bend the skin by the skeleton alone, not by the muscles beneath it
cli-arg-no-see-through = Hide the muscles beneath the skin of a clip
cli-arg-no-normals = Use the normal of each triangle instead of the vertex normals in lighting
cli-arg-angles = Elbow angles in degrees; default: 0,30,60,90
cli-arg-joint = Joint whose angle is varied, by its name in the muscle file; the others are at rest
cli-arg-sweep = Elbow angles from FROM to TO, both included, every STEP degrees
cli-arg-compare = Compare the model with measured radii: a CSV file with a column “node” and columns deg0, deg30 …
cli-arg-bench-threads = Number of worker threads; default: one per core
cli-arg-bench-file = Files to draw in addition to the built-in scenes
cli-arg-bench-scene = Only the scenes whose name contains this text
cli-arg-seconds = Longest time for each scene, 0.01 to 60 seconds; default: 1
cli-arg-csv = Print CSV

cli-example-start = open the window on the built-in biceps
cli-example-open = open a clip and a muscle together
cli-example-info = print what the clip contains
cli-example-info-json = the same for a program, from standard input
cli-example-check = diagnostics of every clip in the folder
cli-example-check-json = the same for a program
cli-example-render = one image at 1.5 s, with bones
cli-example-render-gif = the whole clip as an animation
cli-example-render-sequence = 61 numbered images of the first two seconds
cli-example-render-turntable = the bent arm from all sides
cli-example-export = the mesh in its pose at 1.5 s
cli-example-export-muscle = arm and muscle at 90°
cli-example-measure = a table at four angles
cli-example-measure-csv = every five degrees, for a spreadsheet
cli-example-measure-compare = the model compared with measured radii
cli-example-bench = every scene with all cores
cli-example-bench-threads = the same with one thread
cli-example-bench-file = one file of your own, in several sizes
cli-example-help = help for render
cli-usage-error = The call could not be parsed; see sinew --help.

# The command line: what was wrong with a call. Each is printed after "sinew: ".
cli-option-unknown = There is no option { $option }; see --help.
cli-option-unknown-similar = There is no option { $option }; did you mean { $similar }?
cli-option-twice = { $option } may be given only once.
cli-options-contradict = { $one } and { $other } contradict each other; give one of them.
cli-argument-too-many = Unexpected argument “{ $argument }”; see --help.
cli-argument-missing = { $what } is missing; see --help.
cli-argument-empty = { $what } is empty; give the name of a file.
cli-stdin-twice = “-” is given more than once; standard input can be read only once.
cli-value-missing = { $option } needs a value; see --help.
cli-value-not-taken = { $option } takes no value: unexpected value “{ $value }”.
cli-value-not-one-of = { $option }: “{ $value }” is none of { $choices }.
cli-value-wrong = { $option }: “{ $value }” { $why }
cli-value-not-text = An option's value is not valid UTF-8 text.
cli-value-not-finite = is not finite; give a finite number.
cli-value-decimal-comma = has a decimal comma; write a point, as in 1.5.
cli-value-not-number = is not a number; write it as in 1.5.
cli-value-out-of-range = is outside { $low } to { $high }.
cli-value-not-size = is not a size; write WIDTHxHEIGHT as in 1280x720, each from 1 to { $limit } pixels.
cli-value-not-point = is not a position; write X,Y,Z in metres as in 1,2.5,-1.
cli-value-not-color = is not a colour; write #rrggbb, #rgb, a name such as white, or none.
cli-value-not-count = is not a number of threads; write a whole number from 1 to { $limit }.
cli-value-not-angles = is not a list of angles; write degrees as in 0,30,60,90.
cli-value-not-sweep = is not a range; write FROM:TO:STEP in degrees as in 0:120:5.
cli-value-sweep-empty = contains no angle: the step must not be 0 and must lead from FROM to TO.
cli-value-sweep-too-fine = has a step too small to tell neighbouring angles apart; give a larger step.
cli-value-not-times = is not a range of times; write FROM:TO:STEP in seconds as in 0:4:0.1.
cli-value-times-empty = contains no time: the step must not be 0 and must lead from FROM to TO.
cli-value-too-many-times = gives more than { $limit } times; give a larger step.
cli-value-times-too-fine = has a step too small to tell neighbouring times apart; give a larger step.
cli-value-too-many-angles = gives more than { $limit } angles; give a larger step.
cli-no-such-command = There is no command “{ $name }”; see sinew --help.
cli-no-such-command-similar = There is no command “{ $name }”; did you mean { $similar }?
cli-command-mistyped = There is neither a file nor a command “{ $word }”; did you mean “{ $name }”?
cli-command-unknown = There is neither a file nor a command “{ $word }”; see sinew --help.
cli-no-such-clip = { $file } has no clip “{ $name }”; its clips: { $names }.
cli-no-clips = { $file } has no clip “{ $name }”; the file has no clips.
cli-no-muscle-to-drive = { $file } has no muscle, so --contraction has no effect.
cli-nothing-to-contract = { $file }: no joint changes the length of its muscles, so --contraction has no effect.
cli-no-arm-to-bend = { $file } has no arm, so --angle has no effect; use --contraction.
cli-no-elbow-to-bend = No elbow was detected in { $file }, so --angle has no effect; a muscle file can name the joint, as in joint: {"{"}bone: forearm, axis: [1, 0, 0]{"}"}.
cli-no-arm-to-measure = The muscle of { $file } is not on an arm, so there is no angle to measure at; remove --angles and --sweep.
cli-no-arm-to-compare = The muscle of { $file } is not on an arm, so there is no angle to compare at; remove --compare.
cli-needs-sequence = { $option } needs several images: name OUT with the ending .gif, .apng, .mp4 or .webm, or with a pattern such as frame-%04d.png.
cli-range-empty = --from { $from } lies after --to { $to }, so there is no frame to draw.
cli-range-late = { $file }: the animation ends at { $end } s, so there is no frame to draw from --from { $from } on.
cli-range-early = { $file }: the animation starts at { $start } s, so there is no frame to draw up to --to { $to }.
cli-too-many-frames = The animation would have more than { $limit } frames; give a shorter range or a lower --fps.
cli-gif-fps = A .gif shows at most { $limit } frames per second; give a lower --fps or write numbered images.
cli-render-ending = { $out }: the name must end in .png, .gif, .apng, .mp4 or .webm.
cli-ending-alone = { $out } consists of an ending only; put a name before it.
cli-pattern-twice = { $out } has two number patterns; keep one of them, or write %% for a percent sign.
cli-pattern-one-file = { $out }: a number pattern such as %d is for numbered images, which sinew render writes as .png; this command writes one file, so give it a name without %d.
cli-export-ending = { $out }: the name must end in .obj, .ply or .stl.
cli-out-is-input = { $out } is one of the input files; choose another name for the result.

# The command line: files that could not be used, notices, results.
cli-no-window = This build has no window. To draw an image without one: sinew render FILE -o image.png
cli-window-not-started = The window cannot be opened: { $program } does not start ({ $reason }). This program is built and installed together with sinew.
cli-no-display = There is no display to open a window on. To draw an image without one: sinew render FILE -o image.png
cli-simd-empty = The variable SINEW_SIMD is empty; set it to an instruction set ({ $names }) or unset it.
cli-simd-unknown = SINEW_SIMD is “{ $name }”, which is not an instruction set that Sinew knows: { $names }.
cli-simd-missing = SINEW_SIMD is “{ $name }”, which this processor does not support; it supports { $names }.
cli-stdout-failed = Standard output: { $reason }.
cli-angle-held = { $file }: the elbow goes from { $low }° to { $high }°; { $angle }° is clamped to this range.
cli-export-nothing = There is no surface to export: the scene has no mesh with faces and no muscle.
cli-check-clean = no problems.
cli-measure-beyond = { $file }: the joint goes from { $low }° to { $high }°; angles beyond this range were computed without the limit.
cli-measure-angle = angle, °
cli-measure-length = belly, { $unit }
cli-measure-unit-length = muscle-tendon unit, { $unit }
cli-measure-no-joints = No muscle of { $file } has a joint to measure over, so there is no joint “{ $joint }”; remove --joint.
cli-measure-unknown-joint = No muscle file of { $file } has a joint “{ $joint }”; it has: { $known }.
cli-measure-moment-arm = moment arm, { $unit }
cli-measure-volume = volume, { $unit }³
cli-measure-error = volume error
cli-measure-delta = δ
cli-measure-largest = largest radius, { $unit }
cli-unit-mm = mm
cli-unit-cm = cm
cli-unit-m = m
cli-unit-in = in
cli-unit-ml = ml
cli-measure-held = the length is clamped to the allowed range of the muscle.
cli-bench-scene = scene
cli-bench-no-scene = No scene has “{ $text }” in its name; omit --scene to see all scenes.
cli-bench-size = size
cli-bench-triangles = triangles
cli-bench-median = median, ms
cli-bench-min = fastest, ms
cli-bench-pose = pose
cli-bench-vertices = vertices
cli-bench-raster = raster
cli-bench-resolve = resolve
cli-bench-floor = Lower bound, one thread: clearing colour and depth { $clear } ms, depth test and write of the sphere’s pixels { $pass } ms, copying the image { $copy } ms.
cli-bench-made = Instruction set { $simd }, { NUMBER($threads, useGrouping: 0) } { $threads ->
        [one] thread
       *[other] threads
    }.
cli-info-file = File
cli-info-format = Format
cli-info-tool = Made with
cli-info-axis = Up axis
cli-info-unit = Unit
cli-info-metres = { $value } m
cli-info-nodes = Nodes
cli-info-nodes-value = { NUMBER($nodes, useGrouping: 0) }, of them { NUMBER($joints, useGrouping: 0) } { $joints ->
        [one] joint
       *[other] joints
    }
cli-info-mesh = Mesh
cli-info-mesh-value = “{ $name }”: { NUMBER($vertices, useGrouping: 0) } vertices, { NUMBER($triangles, useGrouping: 0) } triangles
cli-info-mesh-joints = , skin with { NUMBER($joints, useGrouping: 0) } joints
cli-info-mesh-morphs = , { NUMBER($targets, useGrouping: 0) } morph targets
cli-info-clip = Clip
cli-info-clip-value = “{ $name }”: { $start } s to { $end } s, { NUMBER($channels, useGrouping: 0) } channels, { NUMBER($keys, useGrouping: 0) } keyframes
cli-info-materials = Materials
cli-info-image = Image
cli-info-image-found = { $uri }
cli-info-image-missing = { $uri } (not found)
cli-info-muscle = Muscle
cli-info-muscle-value = “{ $name }”: { NUMBER($nodes, useGrouping: 0) } nodes, rest length { $length } { $unit }, volume { $volume } { $unit }³
cli-info-bounds = Bounds
cli-info-bounds-value = { $min } to { $max } m
cli-info-warnings = Diagnostics

# Measured radii.
cli-table-not-text = This is not UTF-8 text; measured radii are given as a CSV file.
cli-compare-title = { $name }: radii in { $unit }, model and measurements
cli-compare-node = node
cli-compare-model = { $angle }° model
cli-compare-measured = measured
cli-compare-rms = RMS difference
cli-compare-volume = volume, { $unit }
cli-compare-ratio = From { $from }° to { $to }° the measured radii grow { $ratio } times as much as those of the model.
cli-compare-explained = The measured radii do not keep their volume: it differs by { $spread } % between angles, so no muscle of constant volume can follow them.

# Writing files.
export-not-written = The file could not be written: { $reason }.
export-not-a-file = This is a folder or a device; choose a file name for the result.
export-held = This file is open or belongs to an open document, and a result never replaces it; choose another name.
export-too-much = Converting this document would take more than { NUMBER($limit, useGrouping: 0) } MB; nothing was written.
export-too-large = This format allows at most { NUMBER($limit, useGrouping: 0) } pixels per side.

cli-about-fit = Creates a muscle file from measured radii: growth multipliers by least squares under constant volume, or the measured poses.
cli-arg-fit-table = Measured radii: a row “node,deg0,deg30 …” and a row for each node
cli-arg-fit-output = Output file: the muscle (.yaml)
cli-arg-like = Muscle file that gives the arm, attachments and unit; default: the measured biceps (OpenArm 2.0)
cli-arg-model = Model to write: growth multipliers (the default) or measured poses
cli-example-fit = growth multipliers on the arm of the measured biceps
cli-example-fit-poses = the measured poses, on another arm
cli-fit-ending = { $out }: the name of a muscle file ends in .yaml.
cli-like-no-muscle = This file has no muscle; --like needs a muscle file, which gives its arm, attachments and unit to the new one.
cli-fit-source = Fitted to { $table } under constant volume; RMS difference { $rms }.
cli-rms-title = RMS difference from the measured radii, in { $unit }, all at the volume of the first angle:
cli-rms-own = growth multipliers of the file
cli-rms-fitted = fitted growth multipliers
cli-rms-poses = measured poses
cli-compare-growth = Growth from { $from }° to { $to }° in { $unit }
cli-compare-grown-model = model
cli-compare-times = measured / model
cli-about-convert = Writes the whole scene as glTF 2.0: nodes, skins, morphs, clips, materials, images; muscles as morph targets.
cli-arg-convert-output = Output file: .glb (one binary file) or .gltf (text)
cli-example-convert = a clip with its skeleton, for any program that reads glTF
cli-example-convert-muscle = the flexing arm with its muscle as morph targets
cli-convert-ending = { $out }: the name must end in .glb or .gltf.
gltf-shear = The animation of node “{ $node }” contains shear, which glTF does not support; it is written without shear.
gltf-skin-shapes = The skin over the muscles has too many vertices or keyframes for an error below 0.5 mm; morph targets per mesh: { NUMBER($count, useGrouping: 0) }.
gltf-colours = Clip “{ $clip }” animates colours or lights; glTF animates only nodes and morph weights, so colours and lights keep their rest values.
gltf-image = The image “{ $name }” is missing or cannot be read and is ignored.
gltf-ambient = The light “{ $name }” is ambient; glTF has no ambient light, so it is ignored.
gltf-following-skin = The mesh “{ $mesh }” has morph targets of its own and follows muscles, which is not written to glTF together; it is written without following the muscles.
gltf-mixed = The mesh “{ $mesh }” is morphed after skinning, which glTF does not support; it is written in its pose at the start.
gltf-moved = Clip “{ $clip }” starts before 0 s, which glTF does not allow; its keyframes are shifted by { NUMBER($milliseconds, useGrouping: 0) } ms.
gltf-shapes = { $count ->
    [0] The muscles have too many vertices for morph targets; they are written without animation.
    [one] The muscles have too many vertices or keyframes for an error below 0.5 mm; one morph target per muscle is written.
   *[other] The muscles have too many vertices or keyframes for an error below 0.5 mm; up to { NUMBER($count, useGrouping: 0) } morph targets per muscle are written.
}
# Films, shells, questions.
cli-about-completions = Prints a completion script for a shell.
cli-arg-shell = The shell: bash, zsh or fish
cli-arg-quiet = Report only errors and warnings; never prompt
cli-arg-verbose = Also report diagnostics of the files and the files written
cli-arg-force = Replace existing files without a prompt; without a terminal there is never a prompt
cli-arg-scale = Scale factor of the whole image, lines included: 2 gives twice the columns and rows
cli-arg-duration = Length of the animation in seconds, instead of --to; default for a turn, a flexion and a sweep: 4
cli-arg-sweep-angle = Bend the elbow from one angle to another over the animation, degrees
cli-arg-sweep-contraction = Contract the muscle from one value to another over the animation, percent
cli-arg-grid = Draw the ground grid
cli-arg-axes = Draw the world axes
cli-arg-bounding-box = Draw the bounding box
cli-arg-lines-of-action = Draw the lines of action of muscles
cli-example-render-sweep = the elbow flexes in an animation of three seconds
cli-example-completions = bash completion for the current user
cli-value-not-span = is not a range; write FROM:TO as in { $example }.
cli-scale-too-large = --scale makes a side longer than { $limit } pixels; give a smaller factor.
cli-progress = Frame { NUMBER($done, useGrouping: 0) } of { NUMBER($count, useGrouping: 0) }
cli-written = { $out }: { NUMBER($count, useGrouping: 0) } { $count ->
        [one] frame
       *[other] frames
    } of { $width } × { $height } pixels written.
cli-export-written = { $out }: written.
cli-ask-overwrite = { $out } already exists{ $more ->
        [0] {""}
       *[other] , and { NUMBER($more, useGrouping: 0) } more
    }. Replace? [y/N]
cli-left-alone = not replaced.
export-cancelled = Stopped; nothing was written.
export-no-ffmpeg = This video format needs ffmpeg, which is not installed; install it, or choose .gif, .apng or numbered images.
export-no-codec = The installed ffmpeg has no encoder for this video format ({ $names }); choose .gif, .apng or numbered images.
export-encoder-failed = ffmpeg could not write the video: { $reason }

cli-arg-times = Times in seconds of the clip that moves the bones, instead of angles
cli-example-measure-times = over the duration of the clip, for a spreadsheet
cli-measure-time = time, s
cli-measure-no-clip = { $file } has no clip, so there is no time to measure over; remove --times and --joints.
cli-measure-no-joint-no-clip = { $file } has no joint and no clip that would move one; remove --joints.
cli-measure-time-held = { $file }: the clip goes from { $start } s to { $end } s; times beyond are clamped to its ends.
cli-arg-joints = Angles of every joint over the clip, 25 times per second or at --times: flexion between its two bones and rotation from the rest pose
cli-example-measure-joints = the angles of all joints over the clip, for a spreadsheet
cli-joints-name = joint
cli-joints-flexion-least = flexion from, °
cli-joints-flexion-most = to, °
cli-joints-rotation-least = rotation from rest from, °
cli-joints-rotation-most = to, °
table-no-clip = This file has no animated clip, so nothing can be measured over time.
table-no-muscle = This file has no muscle, so nothing can be measured.
table-no-joint = This file has no joint, so nothing can be measured.
table-too-long = The table would have more than { NUMBER($limit, useGrouping: 0) } rows; choose fewer times.
cli-arg-plot = Draw the curves to a .png or .svg file; without angles or times: for each degree, or over the clip
cli-arg-plot-scale = Scale factor of a .png, relative to a width of 848 pixels, 0.1 to 8; default: 2
cli-arg-published = Draw the moment arm of each muscle alone, with published ones of biceps, triceps or brachialis behind it
cli-measure-none-published = “{ $file }” has no muscle of an elbow whose moment arm was published: one that is called biceps, triceps or brachialis.
cli-measure-units-differ = The files give lengths in different units; measure them one by one.
cli-example-measure-published = moment arms over those of Arm26
cli-example-measure-plot = length, moment arm, radius and volume as curves
cli-plot-ending = { $out }: the name must end in .png or .svg.
plot-flexion = flexion, °
plot-rotation = rotation from the rest pose, °
plot-some = { $what } (the { NUMBER($shown, useGrouping: 0) } joints of { NUMBER($all, useGrouping: 0) } with the largest range)

cli-about-attach = Puts a set of muscles of published models on the bones of a figure and writes them as a muscle file.
cli-arg-attach-output = Output file: the muscles (.yaml), which name the clip
cli-arg-set = Muscles of the arms (Arm26), of the legs (Gait2392), or of both
cli-arg-side = Sides of the body that get muscles; default: both
cli-example-attach = muscles of both legs
cli-example-attach-side = muscles of the left side
cli-attach-several-figures = { $file }: there are { $count } figures; the first one gets the muscles.
cli-attach-written = { $out }: { $count ->
    [one] { $count } muscle
   *[other] { $count } muscles
} written.
