# The command line: help pages.
cli-about =
    Opens skeletal animation clips (COLLADA .dae, .zae) and muscles of constant volume (.yaml) in one scene.
    Without a command it opens the window; without a file, on the built-in biceps.
cli-about-info = Says what is in a file: nodes, meshes, clips, images, muscles, bounds.
cli-about-check = Reads files and reports what is odd about them, with the line and what was done about it.
cli-about-render = Draws a picture (.png), a film (.gif, .apng; .mp4 and .webm by ffmpeg) or numbered pictures, without a screen.
cli-about-export = Writes the posed surface as .obj (with .mtl), .ply or .stl: world space, metres, Y up, triangles with normals.
cli-about-measure = Measures muscles: length, moment arm, volume and radii at each elbow angle.
cli-about-bench = Measures how fast the rasterizer is on this machine.
cli-about-help = Shows this page, or the page of a command.

cli-heading-usage = Usage:
cli-heading-commands = Commands
cli-heading-arguments = Arguments
cli-heading-options = Options
cli-heading-output = Output
cli-heading-moment = Moment
cli-heading-view = View
cli-heading-look = Look
cli-heading-examples = Examples:
cli-word-options = OPTIONS
cli-help-closing = Exit code: 0 = done, 1 = a file could not be used, 2 = the call was wrong. "-" as a file is standard input.

cli-arg-files = Files to open side by side in one scene
cli-arg-file = The file: .dae, .zae or .yaml
cli-arg-check-files = Files to read
cli-arg-render-files = Files to draw, side by side in one scene
cli-arg-command = The command whose page is shown
cli-arg-help = Show this help
cli-arg-version = Show the version
cli-arg-json = Answer as JSON
cli-arg-render-output = Where to write: .png, .gif, .apng, .mp4, .webm, or a pattern such as frame-%04d.png for one picture a frame, numbered from 0
cli-arg-export-output = Where to write: a file that ends in .obj, .ply or .stl
cli-arg-size = Size of the picture in pixels; 1280x720 unless given
cli-arg-samples = Samples a pixel: 4 smooths edges (the default), 1 is quicker
cli-arg-background = What stands behind: #rrggbb, #rgb, a name such as white, or none for a transparent picture; a soft gradient unless given
cli-arg-threads = Number of worker threads; one a core unless given. The picture is the same for any number
cli-arg-stats = Print to standard error how many milliseconds each stage took (median over the frames)
cli-arg-time = The moment, in seconds on the file's own time axis; held at the ends of the clip. The clip's start unless given
cli-arg-clip = The clip to play, by its name, its id or its place (#2 = the second); unless given the first, or with --time the one that holds that moment
cli-arg-angle = Elbow angle in degrees, 0 = straight arm; of a clip: the elbow that is found in its skeleton, or the joint that a muscle file names
cli-arg-on-top = Add --angle to what the clip does with the joint, instead of replacing it
cli-arg-contraction = Contraction of the muscle, 0 to 100 per cent
cli-arg-from = First moment of an animation, seconds; the clip's start unless given
cli-arg-to = Last moment of an animation, seconds, included; the clip's end unless given
cli-arg-fps = Frames a second of an animation, 0.01 to 1000 (a .gif: up to 50); 25 unless given
cli-arg-camera = Where to look from: orbit has perspective, the others have parallel rays; orbit unless given
cli-arg-yaw = Degrees round the vertical axis instead of the camera's own: 0 = from the front (+Z), 90 = from the right (+X)
cli-arg-pitch = Degrees above the horizon instead of the camera's own, -90 to 90
cli-arg-zoom = How many times nearer than the view that shows all, 0.01 to 100
cli-arg-turntable = Turn the model once round over the animation
cli-arg-light = Position of the light in the world, metres; high on the left of the camera unless given
cli-arg-shading = Where lighting is computed: once a triangle, a vertex (gouraud, the default) or a pixel
cli-arg-bones = Draw the bones
cli-arg-wireframe = Draw the edges of triangles
cli-arg-no-materials = Leave materials and textures out
cli-arg-no-see-through = Hide the muscles that lie under the skin of a clip
cli-arg-no-normals = Light each triangle by its own plane instead of the smooth normals
cli-arg-angles = Elbow angles in degrees; 0,30,60,90 unless given
cli-arg-sweep = Elbow angles from FROM to TO, both included, every STEP degrees
cli-arg-compare = Set the model beside measured radii: a CSV with a column "node" and columns deg0, deg30 …
cli-arg-bench-threads = Number of worker threads; one a core unless given
cli-arg-bench-file = Files to draw besides the built-in scenes
cli-arg-bench-scene = Only the scenes whose name contains this text
cli-arg-seconds = Longest time for each scene, 0.01 to 60 seconds; 1 unless given
cli-arg-csv = Answer as CSV

cli-example-start = open the window on the built-in biceps
cli-example-open = open a clip and a muscle together
cli-example-info = what is in the clip
cli-example-info-json = the same for a program, from standard input
cli-example-check = report on every clip of the folder
cli-example-check-json = the report for a program
cli-example-render = one picture of the moment 1.5 s, with bones
cli-example-render-gif = the whole clip as an animation
cli-example-render-sequence = 61 numbered pictures of the first two seconds
cli-example-render-turntable = the bent arm from all sides
cli-example-export = the mesh as it stands at 1.5 s
cli-example-export-muscle = arm and muscle at 90°
cli-example-measure = a table at four angles
cli-example-measure-csv = every five degrees, for a spreadsheet
cli-example-measure-compare = the model beside measured radii
cli-example-bench = every scene with all cores
cli-example-bench-threads = the same with one thread
cli-example-bench-file = one file of your own, in several sizes
cli-example-help = the page of render

# The command line: what was wrong with a call. Each is printed after "sinew: ".
cli-call-wrong = This call was not understood; see sinew --help.
cli-option-unknown = There is no option { $option }; see --help.
cli-option-unknown-similar = There is no option { $option }; did you mean { $similar }?
cli-option-twice = { $option } may be given only once.
cli-options-contradict = { $one } and { $other } contradict each other; give one of them.
cli-argument-too-many = "{ $argument }" is one argument too many; see --help.
cli-argument-missing = { $what } is missing; see --help.
cli-argument-empty = { $what } is empty; give the name of a file.
cli-stdin-twice = "-" is given more than once; standard input can be read only once.
cli-value-missing = { $option } needs a value; see --help.
cli-value-not-taken = { $option } takes no value, so "{ $value }" is too much.
cli-value-not-one-of = { $option }: "{ $value }" is none of { $choices }.
cli-value-wrong = { $option }: "{ $value }" { $why }
cli-value-not-text = An option's value is not valid UTF-8 text.
cli-value-not-finite = is not finite; give an ordinary number.
cli-value-decimal-comma = has a decimal comma; write a point, as in 1.5.
cli-value-not-number = is not a number; write it as in 1.5.
cli-value-out-of-range = is outside { $low } to { $high }.
cli-value-not-size = is not a size; write WIDTHxHEIGHT as in 1280x720, each from 1 to { $limit } pixels.
cli-value-not-point = is not a position; write X,Y,Z in metres as in 1,2.5,-1.
cli-value-not-color = is not a colour; write #rrggbb, #rgb, a name such as white, or none.
cli-value-not-count = is not a number of threads; write a whole number from 1 to { $limit }.
cli-value-not-angles = is not a list of angles; write degrees as in 0,30,60,90.
cli-value-not-sweep = is not a range; write FROM:TO:STEP in degrees as in 0:120:5.
cli-value-sweep-empty = holds no angle: the step must lead from FROM to TO and not be 0.
cli-value-sweep-too-fine = has a step that is too small to tell one angle from the next; take a larger one.
cli-value-not-times = is not a range of times; write FROM:TO:STEP in seconds as in 0:4:0.1.
cli-value-times-empty = holds no time: the step must lead from FROM to TO and not be 0.
cli-value-too-many-times = makes more than { $limit } times; take a larger step.
cli-value-times-too-fine = has a step that is too small to tell one time from the next; take a larger one.
cli-value-too-many-angles = makes more than { $limit } angles; take a larger step.
cli-no-such-command = There is no command "{ $name }"; see sinew --help.
cli-no-such-command-similar = There is no command "{ $name }"; did you mean { $similar }?
cli-command-mistyped = There is neither a file nor a command "{ $word }"; did you mean "{ $name }"?
cli-command-unheard = There is neither a file nor a command "{ $word }"; see sinew --help.
cli-no-such-clip = { $file } has no clip "{ $name }"; it has: { $names }.
cli-no-clips = { $file } has no clip "{ $name }"; it has none at all.
cli-no-muscle-to-drive = { $file } has no muscle, so --contraction moves nothing.
cli-nothing-to-contract = { $file }: no joint lengthens and shortens its muscles, so --contraction changes nothing.
cli-no-arm-to-bend = { $file } has no arm, so --angle bends nothing; use --contraction.
cli-no-elbow-to-bend = No elbow was found in { $file }, so --angle bends nothing; a muscle file can name the joint, as in joint: {"{"}bone: forearm, axis: [1, 0, 0]{"}"}.
cli-no-arm-to-measure = { $file } has a muscle on no arm, so there is no angle to measure at; leave --angles and --sweep out.
cli-no-arm-to-compare = { $file } has a muscle on no arm, so there is no angle to compare at; leave --compare out.
cli-needs-sequence = { $option } needs several pictures: let OUT end in .gif, .apng, .mp4 or .webm, or name it as in frame-%04d.png.
cli-range-empty = --from { $from } lies after --to { $to }, so there is nothing to draw.
cli-range-late = { $file }: the movement ends at { $end } s, so there is nothing to draw from --from { $from } on.
cli-range-early = { $file }: the movement starts at { $start } s, so there is nothing to draw up to --to { $to }.
cli-too-many-frames = This makes more than { $limit } frames; take a shorter stretch or a lower --fps.
cli-gif-fps = A .gif shows at most { $limit } frames a second; give a lower --fps or write pictures.
cli-render-ending = { $out }: the ending must be .png, .gif, .apng, .mp4 or .webm.
cli-ending-alone = { $out } is an ending alone; put a name before it.
cli-pattern-twice = { $out } has two places for a number; leave one of them, or write %% for a plain per cent sign.
cli-pattern-one-file = { $out }: a place for a number such as %d is for numbered pictures, which sinew render writes as .png; this is one file, so give it a name without %d.
cli-export-ending = { $out }: the ending must be .obj, .ply or .stl.
cli-out-is-input = { $out } is one of the files that are read; choose another name for the result.

# The command line: files that could not be used, notices, results.
cli-no-window = This build has no window; draw without one: sinew render FILE -o picture.png
cli-window-not-started = The window cannot be opened: { $program } does not start ({ $reason }). It is built and installed together with sinew.
cli-no-display = There is no display to open a window on; draw without one: sinew render FILE -o picture.png
cli-simd-empty = The variable SINEW_SIMD is set to nothing; it can name an instruction set ({ $names }), or not be set.
cli-simd-unknown = SINEW_SIMD is "{ $name }", which is not an instruction set that Sinew knows: { $names }.
cli-simd-missing = SINEW_SIMD is "{ $name }", which this processor does not have; it has { $names }.
cli-stdout-failed = Standard output: { $reason }.
cli-angle-held = { $file }: the elbow goes from { $low }° to { $high }°, so { $angle }° is held at the limit.
cli-export-nothing = There is no surface to export: nothing that is drawn here has faces, and there is no muscle.
cli-check-clean = nothing odd.
cli-measure-beyond = { $file }: the joint goes from { $low }° to { $high }°; what lies beyond is computed all the same.
cli-measure-angle = angle, °
cli-measure-length = length, { $unit }
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
cli-measure-held = the length is held at the limit of what the muscle can do.
cli-bench-scene = scene
cli-bench-no-scene = No scene has “{ $text }” in its name; without --scene all of them are shown.
cli-bench-size = size
cli-bench-triangles = triangles
cli-bench-median = median, ms
cli-bench-min = fastest, ms
cli-bench-pose = pose
cli-bench-vertices = vertices
cli-bench-raster = raster
cli-bench-resolve = resolve
cli-bench-floor = Floor, one thread: clearing colour and depth { $clear } ms, depth test and write of the sphere’s pixels { $pass } ms, copying the picture { $copy } ms.
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
cli-info-mesh-value = "{ $name }": { NUMBER($vertices, useGrouping: 0) } vertices, { NUMBER($triangles, useGrouping: 0) } triangles
cli-info-mesh-joints = , skin with { NUMBER($joints, useGrouping: 0) } joints
cli-info-mesh-morphs = , { NUMBER($targets, useGrouping: 0) } morph targets
cli-info-clip = Clip
cli-info-clip-value = "{ $name }": { $start } s to { $end } s, { NUMBER($channels, useGrouping: 0) } channels, { NUMBER($keys, useGrouping: 0) } keys
cli-info-materials = Materials
cli-info-image = Image
cli-info-image-found = { $uri }
cli-info-image-missing = { $uri } (not found)
cli-info-muscle = Muscle
cli-info-muscle-value = "{ $name }": { NUMBER($nodes, useGrouping: 0) } nodes, rest length { $length } { $unit }, volume { $volume } { $unit }³
cli-info-bounds = Bounds
cli-info-bounds-value = { $min } to { $max } m
cli-info-warnings = Findings

# Measured radii.
cli-table-not-text = This is not UTF-8 text; measured radii are given as a CSV file.
cli-compare-title = { $name }: radii in { $unit }, model beside measurement
cli-compare-node = node
cli-compare-model = { $angle }° model
cli-compare-measured = measured
cli-compare-rms = RMS difference
cli-compare-volume = volume, { $unit }
cli-compare-ratio = From { $from }° to { $to }° the measured radii grow { $ratio } times as much as the model's.
cli-compare-explained = The measured radii do not keep their volume: it differs by { $spread } % between angles, so no muscle of constant volume can follow them.

# Writing files.
export-not-written = The file could not be written: { $reason }.
export-not-a-file = This is a folder or a device; choose a file name for the result.
export-held = This file is open or belongs to what is open, and a result never replaces it; choose another name.
export-too-much = Converting this document would take more than { NUMBER($limit, useGrouping: 0) } MB; nothing was written.
export-too-large = This format holds at most { NUMBER($limit, useGrouping: 0) } pixels a side.

cli-about-fit = Makes a muscle file from measured radii: growth multipliers by least squares under conserved volume, or the measured poses themselves.
cli-arg-fit-table = Measured radii: a row "node,deg0,deg30 …" and a row for each node
cli-arg-fit-output = The muscle file to write
cli-arg-like = A muscle file whose arm, ends and unit to take; the report’s measured biceps unless given
cli-arg-model = What to write: growth multipliers (unless given otherwise) or measured poses
cli-example-fit = growth multipliers on the report’s arm
cli-example-fit-poses = the measured poses, on another arm
cli-fit-ending = { $out }: a muscle file’s name ends in .yaml.
cli-like-no-muscle = There is no muscle in this file; --like takes a muscle file, whose arm, ends and unit the new one gets.
cli-fit-source = Fitted to { $table } under conserved volume; RMS difference { $rms }.
cli-rms-title = RMS difference from the measured radii, in { $unit }, all at the volume of the first angle:
cli-rms-own = the file’s growth multipliers
cli-rms-fitted = fitted growth multipliers
cli-rms-poses = measured poses
cli-compare-growth = Growth from { $from }° to { $to }° in { $unit }
cli-compare-grown-model = model
cli-compare-times = measured / model
cli-about-convert = Writes the whole scene as glTF 2.0: nodes, skins, morphs, clips, materials, images; muscles as morph targets.
cli-arg-convert-output = Where to write: a file that ends in .glb (one binary) or .gltf (text)
cli-example-convert = a clip with its skeleton, for any program that reads glTF
cli-example-convert-muscle = the arm bending, with the muscle bulging
cli-convert-ending = { $out }: the ending must be .glb or .gltf.
gltf-shear = Node “{ $node }” shears while it moves; glTF cannot say that, so it moves without.
gltf-colours = Clip “{ $clip }” changes colours or lights; glTF animates only nodes and shapes, so they stay as they are at rest.
gltf-image = The image “{ $name }” is not there or cannot be read, and is left out.
gltf-ambient = The light “{ $name }” comes from everywhere; glTF has no such light, and it is left out.
gltf-mixed = The mesh “{ $mesh }” is morphed after it is skinned, which glTF cannot say; it is written as it stands at the start.
gltf-moved = Clip “{ $clip }” starts before zero, which glTF does not allow; its times are { NUMBER($milliseconds, useGrouping: 0) } ms later.
gltf-shapes = { $count ->
    [0] The muscles have too many vertices for their movement to be written; they keep one shape.
    [one] The muscles have so many vertices that only one shape a clip is written; between shapes they move straight.
   *[other] The muscles have so many vertices that only { NUMBER($count, useGrouping: 0) } shapes a clip are written; between them they move straight.
}
# Films, shells, questions.
cli-about-completions = Prints what a shell needs to complete calls of sinew.
cli-arg-shell = The shell: bash, zsh or fish
cli-arg-quiet = Say nothing but problems; ask nothing
cli-arg-verbose = Also say what was found in the files and what was written
cli-arg-force = Replace files that are there without asking; without a terminal nobody is asked anyway
cli-arg-scale = Make everything in the picture this many times larger, lines too: 2 gives twice the columns and rows
cli-arg-duration = Seconds of an animation, counted from its first moment; instead of --to. A turn, a swing and a sweep take 4 unless given
cli-arg-sweep-angle = Bend the elbow from one angle to another over the animation, degrees
cli-arg-sweep-contraction = Contract the muscle from one value to another over the animation, per cent
cli-arg-grid = Draw the ground grid
cli-arg-axes = Draw the axes of the world
cli-arg-bounding-box = Draw the box round everything
cli-example-render-sweep = the elbow bends in a film of three seconds
cli-example-completions = completions for bash, for yourself
cli-value-not-span = is not a range; write FROM:TO as in { $example }.
cli-scale-too-large = --scale makes a side longer than { $limit } pixels; take a smaller one.
cli-progress = Frame { NUMBER($done, useGrouping: 0) } of { NUMBER($count, useGrouping: 0) }
cli-written = { $out }: { NUMBER($count, useGrouping: 0) } { $count ->
        [one] frame
       *[other] frames
    } of { $width } × { $height } pixels written.
cli-export-written = { $out }: written.
cli-ask-overwrite = { $out } is there already{ $more ->
        [0] {""}
       *[other] , and { NUMBER($more, useGrouping: 0) } more
    }. Replace? [y/N]
cli-left-alone = left as it was.
export-cancelled = Stopped; nothing was written.
export-no-ffmpeg = Films of this kind are made by ffmpeg, which is not installed; install it, or choose .gif, .apng or numbered pictures.
export-no-codec = ffmpeg is here, but without an encoder for this kind of film ({ $names }); choose .gif, .apng or numbered pictures.
export-encoder-failed = ffmpeg could not make the film: { $reason }

cli-arg-times = Times of the clip that moves the bones, in seconds, instead of angles
cli-example-measure-times = over the time of the clip, for a spreadsheet
cli-measure-time = time, s
cli-measure-no-clip = { $file } comes with no clip, so there is no time to measure over; leave --times and --joints out.
cli-measure-no-joint-no-clip = { $file } has no joint and no clip that would move one; leave --joints out.
cli-measure-time-held = { $file }: the clip goes from { $start } s to { $end } s; times beyond are held at its ends.
cli-arg-joints = What every joint does over the clip, 25 times a second or at --times: flexion between its two bones, and its turn from the rest pose
cli-example-measure-joints = the angles of all joints over the clip, for a spreadsheet
cli-joints-name = joint
cli-joints-flexion-least = flexion from, °
cli-joints-flexion-most = to, °
cli-joints-turn-least = turn from rest from, °
cli-joints-turn-most = to, °
table-no-clip = No clip moves anything here, so there is nothing to measure over time.
table-no-muscle = There is no muscle in this file, so there is nothing to measure.
table-no-joint = There is no joint in this file, so there is nothing to measure.
table-too-long = This makes more than { NUMBER($limit, useGrouping: 0) } rows; take fewer moments.
cli-arg-plot = Draw the curves to a .png or .svg file; degree by degree, or over the clip, unless angles or times are given
cli-arg-plot-scale = How many times larger a .png is than 848 pixels across, 0.1 to 8; 2 unless given
cli-example-measure-plot = length, moment arm, radius and volume as curves
cli-plot-ending = { $out }: the ending must be .png or .svg.
plot-flexion = flexion, °
plot-turn = turn from the rest pose, °
plot-some = { $what } (the { NUMBER($shown, useGrouping: 0) } that move most of { NUMBER($all, useGrouping: 0) })
