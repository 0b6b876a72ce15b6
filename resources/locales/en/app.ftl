# The window.
app-name = Sinew
app-title-more = { $file } and { $count } more
app-about = Skeletal animation clips and muscles that keep their volume, in one scene, drawn without a GPU.
app-no-display = There is no display to open a window on. To make a picture without one: sinew render FILE -o picture.png
app-open = Open
app-cancel = Cancel
app-save = Save
app-retry = Try again
app-details = Details
app-bar-close = Close this bar
app-copied = Copied.
app-warning = Warning
app-note = Note
app-line = line { $line }
app-at-line = Line { $line }
app-at-line-column = Line { $line }, column { $column }
app-unit-mm = mm
app-unit-cm = cm
app-unit-m = m
app-unit-s = s
app-unit-cm3 = cm³
app-unit-m3 = m³

# Pages and groups
app-page-muscle = Muscle
app-page-display = Display
app-page-health = Health
app-group-files = Files
app-group-pictures = Pictures and export
app-group-playback = Playback
app-group-time = Time
app-group-camera = Camera and light
app-group-model = Model
app-group-display = Display
app-group-inspection = Inspection
app-group-window = Window
app-group-mouse = Mouse
app-menu-camera = Camera
app-menu-display = Display
app-menu-colours = Colours
app-file-cameras = Cameras of the file

# Commands
app-do-open = Open files
app-do-compare-file = Compare with a file…
app-do-reload = Read again
app-do-previous-file = Previous file in the folder
app-do-next-file = Next file in the folder
app-do-picture = Save picture
app-do-picture-transparent = Save picture without background
app-do-copy-picture = Copy picture
app-do-close = Close
app-do-quit = Quit
app-do-play = Play or pause
app-do-reverse = Play backwards
app-do-frame-back = One frame back
app-do-frame-forward = One frame forward
app-do-second-back = One second back
app-do-second-forward = One second forward
app-do-first = To the start
app-do-last = To the end
app-do-previous-key = Previous key
app-do-next-key = Next key
app-do-slower = Slower
app-do-faster = Faster
app-do-normal-speed = Normal speed
app-do-loop-mode = Loop, once, ping-pong
app-do-mark-a = Set mark A here
app-do-mark-b = Set mark B here
app-do-clear-marks = Clear marks A and B
app-do-time-closer = Timeline closer
app-do-time-wider = Timeline wider
app-do-time-whole = Whole timeline
app-do-sheet = Keys of each bone
app-do-curves = Curves
app-do-previous-clip = Previous clip
app-do-next-clip = Next clip
app-do-fit = Fit to view
app-do-reset-camera = Reset camera
app-do-centre = Centre on the selection
app-do-view-front = Front
app-do-view-back = Back
app-do-view-right = Right
app-do-view-left = Left
app-do-view-top = Top
app-do-view-bottom = Bottom
app-do-view-iso = Isometric
app-do-view-iso-opposite = Isometric from behind
app-do-orthographic = Parallel projection
app-do-fly = Fly
app-do-follow = Follow the selection
app-do-smooth-camera = Smooth camera jumps
app-do-reset-light = Reset light
app-do-tool-navigate = Navigate: drag moves the camera
app-do-tool-move = Move the model
app-do-tool-rotate = Rotate the model
app-do-tool-scale = Scale the model
app-do-reset-model = Reset the model
app-do-contract-more = Contract by 5 %
app-do-contract-less = Relax by 5 %
app-do-elbow-more = Bend the elbow by 5°
app-do-elbow-less = Straighten the elbow by 5°
app-do-undo = Undo
app-do-redo = Redo
app-step = { $what }: { $step } ({ $key })
app-edit-move = move the model
app-edit-rotate = rotate the model
app-edit-scale = scale the model
app-edit-reset-model = reset the model
app-edit-light = move the light
app-edit-visible = show or hide
app-edit-isolate = selection alone
app-edit-turn-by-hand = turn a joint
app-edit-reset-turns = take back turns by hand
app-do-bones = Bones
app-edit-bend = bend the joint
app-edit-contract = contract the muscle
app-edit-release = release the joint
app-edit-joint = choose the joint
app-edit-on-top = bend on top of the clip
app-do-bone-names = Bone names
app-do-bone-axes = Bone axes
app-do-xray = Bones through surfaces
app-do-mesh = Meshes
app-do-muscle = Muscles
app-do-see-through = Muscles through the skin
app-do-materials = Materials and textures
app-do-smooth-normals = Smooth normals in lighting
app-do-normal-glyphs = Normals as lines
app-do-wireframe = Edges
app-do-weights = Weights of the selected bone
app-do-ghosts = Neighbouring moments
app-do-bone-path = Path of the selection
app-do-compare-skinning = Both skinnings side by side
app-do-stop-comparing = Stop comparing
app-do-isolate = Selection alone
app-do-hide = Hide selection
app-do-show-all = Show everything
app-do-grid = Ground grid
app-do-axes = World axes
app-do-bounding-box = Bounding box
app-do-depth-test = Depth test
app-do-cull-back-faces = Hide back faces
app-do-smooth-edges = Smooth edges
app-do-preset-clean = Look: clean
app-do-preset-skeleton = Look: skeleton
app-do-preset-inspection = Look: inspection
app-do-preset-print = Look: print
app-do-flat = Flat
app-do-gouraud = Gouraud
app-do-phong = Phong
app-do-sidebars = Both side panels
app-do-tree = Scene tree
app-do-panel = Right panel
app-do-fullscreen = Full screen
app-do-frame-times = Frame times
app-do-colours-system = As the desktop
app-do-colours-light = Light
app-do-colours-dark = Dark
app-do-menu = Main menu
app-do-help = Help
app-do-shortcuts = Keyboard shortcuts
app-do-about = About Sinew

# Mouse
app-mouse-orbit = Orbit
app-mouse-orbit-how = Drag with the left or middle button
app-mouse-pan = Pan
app-mouse-pan-how = Shift + drag
app-mouse-zoom = Zoom
app-mouse-zoom-how = Wheel, pinch or Ctrl + drag
app-mouse-zoom-pointer = Zoom to the pointer
app-mouse-zoom-pointer-how = Ctrl + wheel
app-mouse-light = Move the light
app-mouse-light-how = Drag with the right button; Shift + right click resets it
app-mouse-pick = Select
app-mouse-pick-how = Click
app-mouse-centre = Centre
app-mouse-centre-how = Double-click
app-mouse-fly = In flight
app-mouse-fly-how = W A S D Q E, Shift faster, Alt slower, wheel sets the speed, Esc lands
app-mouse-time = On the timeline
app-mouse-time-how = Shift + drag marks A and B, wheel steps, Ctrl + wheel looks closer, Shift + wheel slides it

# Picture
app-nothing-drawn = Nothing in this file can be drawn: see Health.
app-viewport = The scene
app-hint = Drag to orbit · Shift+drag to pan · wheel to zoom · right-drag moves the light
app-hint-move = Drag an axis, a square or anywhere · Ctrl snaps · middle button orbits · V goes back
app-hint-rotate = Drag a ring, or anywhere to turn freely · Ctrl snaps to 15° · middle button orbits · V goes back
app-hint-scale = Drag a box, or up to enlarge · Ctrl snaps · middle button orbits · V goes back
app-hint-fly = W A S D and Q E to fly · drag to look · wheel: { $speed } m/s · Esc lands
app-times = { $rate } fps · { $total } ms
    pose { $pose } · vertices { $vertex }
    raster { $raster } · resolve { $resolve }
app-axis-x = X
app-axis-y = Y
app-axis-z = Z
app-numbers-move = Moved, m
app-numbers-rotate = Turned, °
app-numbers-scale = Scale
app-drop-here = Drop to open
app-open-folder = Open folder
app-folder-failed = The folder cannot be shown: { $reason }
app-weights-of = Weights of { $name }
app-status-memory = { $size } MB
app-status-position = { $name }: x { $x }, y { $y }, z { $z } m
app-status-triangles = { $count ->
    [one] { $shown } triangle
   *[other] { $shown } triangles
}
app-picture-title = Save picture
app-picture-copied = The picture is copied.
app-saved = Saved { $file }.
app-unsaved = { $file } could not be saved

# Files
app-loading = Reading { $file } …
app-loading-progress = Reading
app-refused = { $file } cannot be opened
app-kept = What was open stays open.
app-reader-broke = The reader failed on this file. Please report it together with the file.
app-reloaded = Read again: nothing changed.
app-reloaded-changes = Read again: { $changes }.
app-compared-lost = { $file }, which the session compares with, cannot be opened.
app-compared-again = { $file }: { $news }
app-changed-gone = gone: { $names }
app-changed-new = new: { $names }
app-changed-clips-gone = clips gone: { $names }
app-changed-clips-new = new clips: { $names }
app-changed-more = { $names } and { $count } more
app-changed-triangles = { $old } → { $new } triangles
app-changed-seconds = { $old } → { $new } s
app-changed-findings = { $old } → { $new } findings
app-changed-shapes = { $count ->
    [one] { $count } mesh reshaped
   *[other] { $count } meshes reshaped
}
app-changed-curves = { $count ->
    [one] other keys in { $count } channel
   *[other] other keys in { $count } channels
}
app-findings = { $count ->
    [one] One oddity was found while reading; see Health.
   *[other] { $count } oddities were found while reading; see Health.
}
app-choose-compared = Compare with a file
app-choose-title = Open files
app-choose-open = Open
app-choose-ours = Animation clips and muscles
app-choose-all = All files
app-recent = Recent files
app-recent-none = None yet
app-settings-broken = The settings in { $file } cannot be read and were ignored: { $reason }
app-settings-unsaved = The settings could not be saved: { $reason }
app-missing = no { $what }
app-missing-still = no { $what }: nothing moves
app-missing-mesh = mesh
app-missing-skeleton = skeleton
app-missing-animation = animation

# Start page
app-start-title = Nothing is open
app-start-text = Open a COLLADA clip (.dae, .zae) or a muscle (.yaml), or drop files here.
app-start-open = Open files
app-start-more = Open something else
app-start-back = Back to the scene
app-start-demos = Demos
app-demo-biceps = Measured biceps
app-demo-curl = Biceps and triceps on a curling arm
app-demo-atlas = Muscles in a glass arm
app-demo-walker = Walking robot
app-demo-lamp = Swinging lamp
app-demo-unwritten = The demos cannot be written to { $folder }
app-do-save-session = Save session as…
app-do-start-page = Start page
app-session-title = Save session
app-session-saved = Session saved to { $file }

# Timeline
app-play = Play
app-time = Time
app-time-tip = Time in seconds
app-clip = Clip
app-speed = Speed; below 0 plays backwards
app-seconds = Time
app-seconds-tip = Exact time, seconds
app-frame = Frame
app-frame-tip = Frame number
app-no-animation = No animation
app-loop = loop
app-once = once
app-ping-pong = ping-pong
app-loop-tip = At the end: { $mode } ({ $key })
app-rate = { $rate } fps
app-rate-own = Auto: { $rate } fps
app-rate-tip = Frames a second of the frame numbers
app-sheet-none = Nothing is animated here
app-sheet-row = What the curves belong to
app-sheet-graph = Which curves
app-sheet-values = { $time }:   { $values }
app-graph-translation = Position
app-graph-rotation = Rotation, °
app-graph-scale = Scale
app-graph-other = Other numbers
app-graph-weights = Morph weights
app-graph-colour = Colour
app-graph-shininess = Shininess
app-graph-opacity = Opacity

# Scene tree
app-tree = Scene tree
app-search = Find a node
app-tree-nothing = Nothing is open.
app-search-nothing = Nothing is called that.
app-hide-node = Show or hide

# Muscle
app-contraction = Contraction
app-contraction-tip = Contraction in percent; the elbow follows
app-elbow = Elbow angle
app-elbow-tip = Elbow angle in degrees; the contraction follows
app-elbow-clip-tip = Bends this joint by hand, in degrees, instead of the clip or on top of it
app-joint = Joint
app-joint-tip = Which joint the slider bends
app-joint-found = { $name } (found)
app-joint-angle = Angle
app-joint-axis = Axis
app-joint-axis-hinge = hinge
app-joint-on-top = On top of the clip
app-joint-on-top-tip = On: adds to what the clip does with the joint. Off: the joint has this angle, whatever the clip does.
app-joint-release = Release
app-held-elbow = Elbow held at { $angle }
app-held-joint = “{ $joint }” held at { $angle }
app-joint-release-tip = Gives the joint back to the clip
app-new-muscle = New
app-new-muscle-tip = Add a muscle: on the arm, or on the bones that meet in the selected joint or in the elbow
app-muscle-menu = Copy, delete, put a ready muscle in its place
app-do-new-muscle = Add a muscle
app-do-duplicate-muscle = Duplicate
app-do-delete-muscle = Delete
app-do-pick-origin = Pick the origin’s bone
app-do-pick-insertion = Pick the insertion’s bone
app-muscle-replace = Put in its place
app-muscle-name = Name
app-fit-length = Take the present length as rest length
app-fit-length-tip = The muscle rests at the length that it has now between its ends
app-ends-heading = Ends
app-ends-none = none
app-origin = Origin
app-origin-bone = Bone of the origin
app-origin-pick = Pick the bone of the origin
app-origin-x = Origin: offset along the bone’s X axis
app-origin-y = Origin: offset along the bone’s Y axis
app-origin-z = Origin: offset along the bone’s Z axis
app-insertion = Insertion
app-insertion-bone = Bone of the insertion
app-insertion-pick = Pick the bone of the insertion
app-insertion-x = Insertion: offset along the bone’s X axis
app-insertion-y = Insertion: offset along the bone’s Y axis
app-insertion-z = Insertion: offset along the bone’s Z axis
app-via = Via points
app-via-unit = Via points, { $unit }
app-via-number = Via point { $number }
app-via-short = { $number }.
app-via-bone = Bone of via point { $number }
app-via-pick = Pick the place of via point { $number }
app-via-delete = Delete via point { $number }
app-via-up = Pass via point { $number } earlier, nearer to the origin
app-via-down = Pass via point { $number } later, nearer to the insertion
app-via-x = Via point { $number }: offset along the bone’s X axis
app-via-y = Via point { $number }: offset along the bone’s Y axis
app-via-z = Via point { $number }: offset along the bone’s Z axis
app-via-add = Add via point
app-via-add-tip = A new point half-way along the longest stretch; drag it in the picture
app-via-pick-new = Pick the place of a new via point
app-wrap = Wrap round a joint
app-wrap-on = Ball on
app-wrap-bone = Bone that carries the ball the muscle goes round; the ball goes into its joint
app-wrap-pick = Pick the bone whose joint the muscle goes round
app-wrap-centre = Middle of the ball
app-wrap-centre-short = Middle
app-wrap-x = Middle of the ball: offset along the bone’s X axis
app-wrap-y = Middle of the ball: offset along the bone’s Y axis
app-wrap-z = Middle of the ball: offset along the bone’s Z axis
app-wrap-radius = Radius of the ball
app-wrap-radius-short = Radius
app-wrap-side = Side
app-wrap-side-x = Side on which the muscle passes: share along the bone’s X axis
app-wrap-side-y = Side on which the muscle passes: share along the bone’s Y axis
app-wrap-side-z = Side on which the muscle passes: share along the bone’s Z axis
app-wrap-flip = Pass the ball on its other side
app-hint-pick-origin = Click the bone from which the muscle comes, here or in the tree · Esc leaves
app-hint-pick-insertion = Click the bone to which the muscle goes, here or in the tree · Esc leaves
app-hint-pick-via = Click the place on a bone that the muscle passes, here, or a bone in the tree · Esc leaves
app-hint-pick-wrap = Click the bone whose joint the muscle goes round, here or in the tree · Esc leaves
app-which-muscle = Muscle
app-no-muscle = There is no muscle in this scene. Add one with New, or open a muscle file (.yaml).
app-held = The muscle cannot get this long or short and keep its volume. Its length is held at the limit.
app-alone = The muscle lies on its own. Give it an origin and an insertion below.
app-alone-twisted = “{ $joint }” turns about the bone itself, so no side of it is for a muscle to cross, and this one lies on its own. Choose another axis for the joint and add it again, or give it an origin and an insertion below.
app-on-own-arm = These muscles are on an arm of their own, beside the clip.
app-hang = Attach to “{ $joint }” of the clip
app-hang-tip = Hangs the muscles of this file on the bones that meet in this joint, as long and as thick as those bones are. Select another bone to choose another joint; Undo puts them back on their arm.
app-hung = { $count ->
    [one] The muscle hangs on “{ $joint }” now. Undo puts it back on its arm.
   *[other] { $count } muscles hang on “{ $joint }” now. Undo puts them back on their arm.
}
app-profile = Profile
app-profile-tip = The muscle from the side: now (red) and at rest (dashed). Drag a handle to change the radius, with Shift the growth.
app-profile-legend = red: now · dashed: at rest
app-profile-node = node { $node }: { $now } (at rest { $rest })
app-volume-heading = Length and volume
app-length = Length L
app-rest-length = Rest length L₀
app-shortening = Change of length
app-volume = Volume V
app-rest-volume = Rest volume V₀
app-volume-error = Error V / V₀ − 1
app-delta = Growth step δ
app-quadratic-heading = Why it bulges: A δ² + B δ + C = 0
app-a = A
app-b = B
app-c = C
app-discriminant = B² − 4AC
app-root-taken = Root taken
app-root-other = Other root
app-nodes-heading = Nodes
app-node-number = Node
app-node-rest = Rest, { $unit }
app-node-growth = Growth
app-node-now = Now, { $unit }
app-ledger-arm = Moment arm
app-ledger-thickest = Largest radius
app-ledger-thickest-value = { $radius } (node { $node })
app-limits = It can be { $short } short ({ $short_cause }) and { $long } long ({ $long_cause }).
app-limit-discriminant = there B² − 4AC is 0
app-limit-radius = there the radius of node { $node } is 0
app-limit-shortest = no belly contracts below 40 % of its rest length
app-limit-reach = this program goes no further
app-root-larger = Taken is the root that goes to 0 as L goes to L₀: the larger one, because B is not negative.
app-root-smaller = Taken is the root that goes to 0 as L goes to L₀: the smaller one, because B is negative.
app-root-double = Both roots are the same: the length is at its limit.
app-node-radius = Radius at rest
app-node-radius-tip = Radius of node { $number } at rest; Enter takes it
app-node-growth-tip = How much node { $number } grows, compared with the others; Enter takes it
app-node-add = Add node
app-node-add-tip = A new node behind the one at hand; the length stays
app-node-delete = Delete node
app-node-delete-number = Delete node { $node }
app-node-delete-tip = Takes away the node at hand; the length stays
app-shape-heading = Length, tendons, colour
app-tendon-origin-length = Tendon at the origin: length
app-tendon-origin-radius = Tendon at the origin: radius
app-tendon-insertion-length = Tendon at the insertion: length
app-tendon-insertion-radius = Tendon at the insertion: radius
app-muscle-colour = Colour
app-do-save = Save muscle
app-do-save-as = Save muscle as…
app-do-revert = Revert to saved
app-save-title = Save muscle
app-saved-without-comments = Saved { $file }. Comments of the file could not be kept.
app-ask-save = Save the changes to the muscle?
app-ask-save-why = Without saving they are lost.
app-edit-carried = Bring back unsaved changes
app-recovery = The program ended before the changes to the muscles of { $what } were saved. They are still here.
app-recovery-restore = Restore
app-recovery-discard = Discard
app-recovery-unwritten = Changes that are not saved cannot be kept against a crash: { $reason }
app-ask-which = The muscle file was changed by another program while it has unsaved changes here.
app-ask-which-why = Keep your own changes, unsaved as they are, or read the file as it is now and lose them?
app-ask-theirs = Read the file
app-ask-mine = Keep my changes
app-ask-discard = Don’t save

# Display
app-display-surfaces = Surfaces
app-display-bones = Bones
app-display-space = Space
app-display-light = Light
app-display-drawing = Drawing
app-display-presets = Look
app-preset-clean = Clean
app-preset-skeleton = Skeleton
app-preset-inspection = Inspect
app-preset-print = Print
app-grid-cell = Cell of the grid
app-grid-auto = Automatic
app-backdrop = Background
app-backdrop-theme = As the window
app-backdrop-white = White
app-backdrop-grey = Grey
app-backdrop-black = Black
app-line-width = Lines
app-light-yaw = Direction of the light, °
app-light-pitch = Height of the light, °
app-tip-see-through = A skin with muscles beneath it is drawn like glass
app-tip-materials = Colours, textures and shine as the file has them; off: plain clay
app-tip-smooth-normals = Light follows the normals of the file, so that triangles do not show
app-tip-normal-glyphs = A short line out of each point, along its normal
app-tip-wireframe = The edges of all triangles
app-tip-bone-axes = The local X, Y and Z of every bone
app-tip-xray = Bones are drawn over surfaces that hide them
app-tip-weights = How strongly the selected bone moves each point of the skin
app-tip-bounding-box = The smallest box along the axes that holds everything
app-tip-smooth-edges = Four samples a pixel: no steps at edges, more work
app-tip-depth-test = Off: what is drawn later covers what is nearer
app-tip-cull-back-faces = Only triangles that face the camera are drawn
app-tip-frame-times = Milliseconds of each step of drawing, over the picture
app-tip-ghosts = The model some frames before and after, faintly
app-tip-bone-path = The line along which the selection moves in this clip
app-tip-compare-skinning = Linear blend and dual quaternions in one picture
app-tip-shading = Flat: one shade a triangle. Gouraud: lit at its corners. Phong: lit at every pixel.
app-tip-skinning = How bones carry the skin: linear blend, as COLLADA has it, gets thin at twisted joints; dual quaternions do not
app-tip-grid-cell = Side of a square of the ground grid
app-tip-line-width = Width of bones, edges, grid and other lines
app-tip-ambient = Light that comes from everywhere, so that no side is black
app-shading = Shading
app-skinning = Skinning
app-skinning-linear = Linear blend
app-skinning-dual = Dual quaternion
app-ghosts = Ghosts
app-ghosts-before = Before
app-ghosts-after = After
app-ghosts-step = Frames from one to the next
app-compare = Compare
app-compare-with = Compare with
app-compare-file = File…
app-compare-nothing = Nothing
app-compare-clip = Clip { $name }
app-compare-skinning = The other skinning
app-compare-aside = Aside, m
app-compare-later = Ahead, s
app-compare-nothing-common = No joint of the same name
app-compare-joint = Largest joint distance: { $distance } m ({ $name })
app-compare-vertex = Largest vertex distance: { $distance } m
app-compare-ahead = { $name }, { $seconds } s ahead
app-ambient = Ambient
app-light-default = With the camera, high on the left. Right-drag in the picture moves it.
app-light-position = At x { $x }, y { $y }, z { $z } m

# Health
app-health-none = Nothing odd was found.
app-health-warnings = { $count ->
    [one] { $count } warning
   *[other] { $count } warnings
}
app-health-notes = { $count ->
    [one] { $count } note
   *[other] { $count } notes
}
app-health-copy = Copy as text
app-facts-collada = COLLADA { $version }, { $axis }, unit { $unit } m
app-facts-muscles = { $count ->
    [one] One muscle
   *[other] { $count } muscles
}
app-facts-nodes = { $nodes ->
        [one] { $nodes } node
       *[other] { $nodes } nodes
    }, { $meshes ->
        [one] { $meshes } mesh
       *[other] { $meshes } meshes
    }, { $clips ->
        [one] { $clips } clip
       *[other] { $clips } clips
    }

# Measure
app-page-measure = Measure
app-measure-none = There is nothing to measure: no muscle of this scene crosses an elbow.
app-measure-hint = Click or drag in a plot to bend the elbow.
app-measure-angle = Elbow angle, °
app-measure-length = Length, { $unit }
app-measure-arm = Moment arm, { $unit }
app-measure-radius = Largest radius, { $unit }
app-measure-copy = Copy as CSV
app-measure-save = Save…
app-measure-save-title = Save as .csv, .png or .svg
app-measure-against = Against
app-measure-axis-angle = elbow angle
app-measure-axis-time = time of the clip
app-measure-time = Time, s
app-measure-hint-time = Click or drag in a plot to go to that moment.
app-measure-section = Largest cross-section, { $unit }²
app-measure-error = Volume error V / V₀ − 1
app-measure-published = Published moment arms of the biceps

# Export.
app-do-export = Export…
app-export-title = Export
app-export-go = Export…
app-export-kind = File
app-export-picture = Picture (PNG)
app-export-gif = Film (GIF)
app-export-apng = Film, every pixel as drawn (APNG)
app-export-pictures = Numbered pictures (PNG)
app-export-mp4 = Film (MP4, by ffmpeg)
app-export-webm = Film (WebM, by ffmpeg)
app-export-obj = Posed surface with materials (OBJ)
app-export-ply = Posed surface (PLY)
app-export-stl = Posed surface for printing (STL)
app-export-glb = Whole scene (glTF, .glb)
app-export-gltf = Whole scene (glTF, .gltf)
app-export-muscles-csv = Muscles in numbers (CSV)
app-export-muscles-json = Muscles in numbers (JSON)
app-export-joints-csv = Joint angles over the clip (CSV)
app-export-joints-json = Joint angles over the clip (JSON)
app-export-joints = Each joint: flexion and turn from its rest pose, over the whole clip
app-export-muscles = Each muscle: length, moment arm, volume, radii, degree by degree
app-export-muscles-clip = Each muscle: length, moment arm, volume, radii, over the whole clip
app-export-losses = What glTF cannot hold of this scene:
app-export-muscles-png = Muscles as a plot (PNG)
app-export-muscles-svg = Muscles as a plot (SVG)
app-export-joints-png = Joint angles as a plot (PNG)
app-export-joints-svg = Joint angles as a plot (SVG)
app-export-size = Size, pixels
app-export-width = Width, pixels
app-export-height = Height, pixels
app-export-course = What moves
app-export-whole = The whole clip, or one swing of the arm
app-export-marks = The clip between A and B
app-export-elbow = The elbow bends
app-export-contraction = The muscle contracts
app-export-turntable = The model turns once
app-export-sweep = From – to
app-export-from = From
app-export-to = To
app-export-duration = Seconds
app-export-fps = Frames a second
app-export-helps = Bones, grid and other helps as on the screen
app-export-transparent = Without background
app-export-progress = Progress
app-export-frames = { NUMBER($count, useGrouping: 0) } { $count ->
        [one] frame
       *[other] frames
    } of { $width } × { $height } pixels, { $seconds } s
app-export-one = One picture of { $width } × { $height } pixels
app-export-surface = The surface as it stands now: world space, metres, Y up
app-export-scene = Nodes, skins, clips, materials; muscles bulge in any viewer
app-export-gif-fps = A GIF shows at most { $limit } frames a second.
app-ask-replace = “{ $file }” is there already{ $more ->
        [0] {""}
       *[other] , and { NUMBER($more, useGrouping: 0) } more
    }. Replace?
app-ask-replace-why = The file dialog did not ask about this name.
app-replace = Replace
app-export-broke = Something went wrong inside Sinew; nothing was written.
app-export-empty = There is nothing between these moments.
app-export-too-many = This makes more than { NUMBER($limit, useGrouping: 0) } frames; take fewer a second or a shorter stretch.
app-export-no-elbow = There is no elbow here that could bend.
app-export-no-muscle = There is no muscle here that could be contracted.
# Inspector
app-space-tip = Whose axes the numbers are in
app-space-local = Local
app-space-world = World
app-space-bind = Bind
app-space-inverse-bind = Inverse bind
app-inspect-copy = Copy the matrices as text
app-position = Position, m
app-rotation = Rotation, °
app-scale = Scale
app-transform = Transform
app-matrix = Matrix
app-hand = Turn by hand
app-hand-reset = Reset
app-hand-reset-tip = Take back the turns of this joint
app-hand-reset-all = Reset all
app-hand-reset-all-tip = Take back the turns of all joints
app-hand-dual = Dual quaternion blend
app-hand-dual-tip = Blend dual quaternions instead of matrices: a twisted joint keeps its volume
app-turn-x = Turn about X, degrees
app-turn-y = Turn about Y, degrees
app-turn-z = Turn about Z, degrees
app-angle = Joint angle
app-angle-end = The end of a chain has no angle of its own. Choose three bones.
app-angle-choose = Choose three bones
app-angle-from = From
app-angle-corner = At
app-angle-to = To
app-angle-own = Those of the selection
app-angle-value = { $from } – { $corner } – { $to }: { $angle }
app-angle-across = Time, s
app-angle-up = Angle, °
app-mesh-heading = Mesh
app-mesh-points = { $points } points, { $vertices } vertices
app-mesh-triangles = { $triangles } triangles, sets of texture coordinates: { $sets }
app-mesh-skin = Skin: { $joints } joints, { $influences } weights, at most { $most } a point
app-mesh-morph = Morph: { $targets } targets
app-material-texture = { $name } · { $image }
app-material-lost = { $name } · { $image } is missing
app-vertex = Why point { $number } is where it is
app-vertex-bind = (bind shape)
app-vertex-sum = Sum
app-vertex-note = Bone, weight, and weight × where that bone alone would put the point (x, y, z, m). The sum is the point in the picture.
app-vertex-apart = Bone, weight, and weight × where that bone alone would put the point. Dual quaternions draw it { $apart } m away from this sum.
app-vertex-rigid = No skin moves this point: it goes with its node.
app-distance = Between the last two clicks: { $distance } m
app-distance-one = Click a second point to measure the distance.

app-measure-experiment = Experiment…
app-measure-experiment-tip = The muscle beside measured radii, and why they differ
app-experiment = Model beside measurement
app-experiment-title = { $muscle } beside { $file }
app-experiment-about = The model keeps its volume. The last row tells the volume that the measured radii imply at the length that the muscle has at that angle.
app-experiment-radii = Radii, { $unit }
app-experiment-open = Measured radii…
app-experiment-fit = Fit the growth
app-experiment-poses = Take the measured poses
app-experiment-unread = The table was not read
app-do-fit-radii = Fit to measured radii

app-help-title = Help
app-help-open = Open
app-help-open-text = Open a COLLADA clip (.dae, .zae) or a muscle (.yaml) with { $open }, or drop files on the window; a clip and a muscle together become one scene. A file that is written anew is read again by itself. { $start-page } brings demos and recent files.
app-help-look = Look round
app-help-look-text = Drag to orbit, drag with Shift to pan, turn the wheel to zoom, drag with the right button to move the light. { $fit } fits everything, { $view-front }, { $view-right } and { $view-top } look along the axes, { $fly } flies with W A S D until Esc. With { $tool-move }, { $tool-rotate } and { $tool-scale } a drag moves, turns and scales the model instead, { $tool-navigate } goes back to the camera.
app-help-time = Play
app-help-time-text = { $play } plays. A click or a drag on the timeline goes to that moment, { $frame-back } and { $frame-forward } step a frame, { $previous-key } and { $next-key } go from key to key. { $mark-a } and { $mark-b } bound what plays. { $sheet } unfolds the keys of each bone, { $curves } the curves; { $time-closer } looks closer at them all. { $follow } lets the camera go along with the selection.
app-help-inside = Look inside
app-help-inside-text = A click selects, in the picture or in the tree. Below the tree stands where the selection is, what its mesh holds and, after a click on a skin, which bones hold that point. { $bones } shows bones, { $weights } the weights of the selected one, { $ghosts } the moments before and after.
app-help-muscle = Muscles
app-help-muscle-text = Drag “Contraction” or “Elbow angle” on the Muscle page: the other follows, since the volume stays. Drag the profile or type radii to change the muscle; { $undo } takes a step back, { $save } saves. The Measure page plots length and moment arm.
app-help-keep = Take away
app-help-keep-text = { $picture } saves the picture, { $copy-picture } copies it, { $export } saves films, surfaces and tables. { $save-session } saves what is open and how it is looked at.
app-help-trouble = When something is wrong
app-help-trouble-text = The Health page lists whatever is odd in a file, with its line and what was done about it. A file that cannot be opened is named in a bar above the picture, and what was open stays. { $shortcuts } lists all keys; on a terminal there is sinew --help.
