# collada: why a file is refused
collada-too-large = The file is larger than { $limit } MB, the most that is read.
collada-cancelled = Reading was cancelled.
collada-not-xml = This is not an XML document, so it cannot be COLLADA.
collada-not-collada = The document’s root is <{ $element }>; a COLLADA document starts with <COLLADA>.
collada-too-many-elements = The document has too many elements for its size ({ $count }).
collada-too-deep = The elements are nested more than { $limit } levels deep.
collada-too-many-attributes = An element has more than { $limit } attributes.
collada-too-many-prefixes = The document declares more than { $limit } namespace prefixes.
collada-entities = The document’s entities would expand to more than { $limit } MB.
collada-comma = { $element }: in “{ $entry }” a comma stands between numbers. COLLADA separates numbers by blanks; export the file again.
collada-xml = The XML is broken at column { $column }.
collada-xml-close-tag = The XML is broken: expected </{ $expected }>, found </{ $actual }>.
collada-xml-cut-short = The XML ends in the middle: the file is cut short.
collada-xml-unknown-entity = The XML uses the entity &{ $name };, which is not declared.
collada-xml-entity-loop = The XML’s entities refer to each other without an end.
collada-xml-unknown-prefix = The XML uses the namespace prefix “{ $prefix }”, which is not declared.
collada-xml-repeated-attribute = An element has the attribute “{ $name }” twice.
collada-archive-broken = The archive is damaged and cannot be unpacked.
collada-archive-files = The archive holds more than { $limit } files.
collada-archive-large = The archive unpacks to more than reading it may take: { $limit } times its size and 64 MB. Unpack it and open the document in it.
collada-archive-empty = The archive holds no COLLADA document.
collada-archive-root = The archive’s manifest names “{ $path }”, which is not in it.

# collada: findings
collada-encoding = The bytes are not { $named }; read as Windows-1252, so some letters in names may be wrong.
collada-unknown-version = Version “{ $version }” is not known; read as 1.4.1.
collada-bad-unit = The unit “{ $value }” is not a positive number; 1 metre is used.
collada-bad-up-axis = The up axis “{ $value }” is none of X_UP, Y_UP, Z_UP; Y_UP is used.
collada-repeated-id = Another element has this id already; references mean the nearest one that fits.
collada-undeclared-prefix = The namespace prefix “{ $prefix }” is not declared anywhere; names are read without it.
collada-broken-reference = Refers to “{ $target }”, which is not in the file; left out.
collada-wrong-reference = Refers to “{ $target }”, which is a <{ $tag }> and cannot stand here; left out.
collada-external-reference = Refers to another file, “{ $file }”, which is not loaded.
collada-part-broken = This document of the archive cannot be read: { $reason }
collada-part-entities = It declares entities of its own.
collada-reference-cycle = Refers to itself in a circle; left out.
collada-decimal-comma = Numbers have a decimal comma, the first is “{ $entry }”; it is read as a point.
collada-bad-number = { $count ->
    [one] “{ $first }” is not a number; 0 is used.
   *[other] { $count } entries are not numbers, the first is “{ $first }”; 0 is used.
}
collada-not-finite = A value is infinite or not a number; left out.
collada-not-finite-points = Points are infinite or not numbers; what uses them is not drawn.
collada-not-finite-keys = Keys are infinite or not numbers; they are left out.
collada-count-mismatch = The count says { $said }, the data hold { $found }; the data are used.
collada-index-out-of-range = { $count ->
    [one] One face points outside of its lists; it is left out.
   *[other] { $count } faces point outside of their lists; they are left out.
}
collada-values-out-of-range = { $count ->
    [one] One vertex points outside of its lists of normals, texture coordinates or colours; it is drawn without, its normal computed.
   *[other] { $count } vertices point outside of their lists of normals, texture coordinates or colours; they are drawn without, their normals computed.
}
collada-not-finite-values = { $count ->
    [one] One vertex has a normal, texture coordinate or colour that is infinite or not a number; it is drawn without, its normal computed.
   *[other] { $count } vertices have normals, texture coordinates or colours that are infinite or not numbers; they are drawn without, their normals computed.
}
collada-not-finite-weights = { $count ->
    [one] One weight is infinite or not a number; it is left out.
   *[other] { $count } weights are infinite or not numbers; they are left out.
}
collada-no-faces = The mesh has no faces and no lines, so there is nothing to draw.
collada-empty-list = The list is empty; what points into it goes without.
collada-incomplete-primitive = { $count ->
    [one] One face has too few corners; it is left out.
   *[other] { $count } faces have too few corners; they are left out.
}
collada-polygon-too-complex = { $count ->
    [one] One polygon is too intricate to be cut into triangles; it is left out.
   *[other] { $count } polygons are too intricate to be cut into triangles; they are left out.
}
collada-no-positions = The mesh has no positions and is not drawn.
collada-unsupported-geometry = Geometry of the kind <{ $kind }> is not shown.
collada-too-many-uv-sets = More than { $limit } sets of texture coordinates; the others are left out.
collada-no-scene-named = The file does not say which scene to show; the first one is shown.
collada-no-scene = The file has no scene; its parts are shown as they stand.
collada-bottom-row = The last row of a matrix is not 0 0 0 1; these numbers are taken instead.
collada-bad-transform = Needs { $wanted } numbers and has { $found }; left out.
collada-unsupported-element = <{ $element }> is not shown: kinematics and formulas move nothing here.
collada-limit-nodes = The scene has more than { $nodes } nodes or is more than { $depth } levels deep; the rest is left out.
collada-morph-depth = Morph targets are made from one another in more than { $limit } steps; the rest is left out.
collada-limit-reached = The scene grows too large for the file’s size; the rest is left out.
collada-limit-drawn = Drawing all instances would take more than { $limit } MB; the rest is left out.
collada-joint-not-found = { $count ->
    [one] The joint “{ $first }” is not in the scene; it stays in its bind pose.
   *[other] { $count } joints are not in the scene, the first is “{ $first }”; they stay in their bind pose.
}
collada-bind-scale = The skin “{ $skin }” and its bones do not meet at rest: the inverse bind matrix of joint “{ $joint }” makes it { $factor } times as large, and no node makes up for that.
collada-bind-node-scale = The skin “{ $skin }” and its bones do not meet at rest: joint “{ $joint }” makes it { $factor } times as large as the node that holds it does, and a skin does not go along with its node.
collada-bind-node-turn = The skin “{ $skin }” and its bones do not meet at rest: joint “{ $joint }” turns it { $angle }° away from the node that holds it, and a skin does not go along with its node.
collada-skeleton-not-in-scene = The skeleton is not part of the scene; it was added to it.
collada-joint-names-rejoined = Joint names have blanks in them; they were put together again.
collada-joint-count = There are { $names } joint names and { $matrices } inverse bind matrices; those that have both are used.
collada-bad-skin = The skin has no usable { $what }; the mesh is shown without it.
collada-no-weights = The skin has no usable WEIGHT; the mesh keeps to its bind shape.
collada-no-inverse-bind = The skin has no usable INV_BIND_MATRIX; its joints are taken to be bound at the origin.
collada-second-skin = The mesh has a skin over a skin; only the one nearer to the mesh is used.
collada-nothing-to-show = The file has no scene and no geometry: there is nothing to show.
collada-stride-mismatch = The stride says { $said }, the params take { $found }; { $found } is used.
collada-skin-points = The weights speak of { $found } points, the mesh has { $wanted }; points without weights keep to their bind shape.
collada-influences-out-of-range = { $count ->
    [one] One weight names a joint or value that is not there; it is left out.
   *[other] { $count } weights name joints or values that are not there; they are left out.
}
collada-influences-missing = { $count ->
    [one] One weight is missing at the end of the list.
   *[other] { $count } weights are missing at the end of the list.
}
collada-weights-not-normalised = { $count ->
    [one] The weights of one point do not add up to 1; they are scaled.
   *[other] The weights of { $count } points do not add up to 1; they are scaled.
}
collada-empty-controller = The controller has neither a skin nor a morph; left out.
collada-bad-morph = The morph has no list of targets; left out.
collada-morph-weights = The morph has fewer weights than targets; 0 is used.
collada-morph-target = The target “{ $target }” has { $found } points, the base { $wanted }; it is not used.
collada-unknown-target = Moves “{ $target }”, which is not in the scene; left out.
collada-unsupported-target = Moves “{ $target }”, which is not shown moving; left out.
collada-bad-sampler = The sampler has no usable times or values; left out.
collada-key-counts = There are { $times } times and { $values } values; the keys that have both are used.
collada-key-size = Each key has { $found } numbers, { $wanted } are needed; left out.
collada-unsupported-interpolation = Interpolation { $name } is read as LINEAR.
collada-missing-tangents = Curved keys have no usable tangents; read as LINEAR.
collada-sheared-keys = Matrix keys shear; they are interpolated element by element.
collada-empty-clip = The clip moves nothing; left out.
collada-unbound-material = The material “{ $symbol }” of the mesh is bound to nothing; a neutral one is used.
collada-texture-not-found = The texture “{ $name }” leads to no image; left out.
collada-no-common-profile = The effect has no common profile; a neutral material is used.
collada-transparency-inverted = By the letter the material would be invisible; its transparency is taken the other way round.
collada-bad-light = The light has no kind that is known; left out.
collada-bad-camera = The camera has no projection; left out.
finding-more-places = { $count ->
    [one] The same once more in this file.
   *[other] The same { $count } times more in this file.
}
collada-more-findings = { $count ->
    [one] One more finding; only the first { $limit } are kept.
   *[other] { $count } more findings; only the first { $limit } are kept.
}

# collada: names for what has none
collada-clip-default = Animation
collada-clip-number = Clip { $number }
collada-unnamed-node = Node { $number }
collada-unnamed-mesh = Mesh
collada-unnamed-skin = Skin
collada-unnamed-morph = Morph
collada-unnamed-material = Material
collada-unnamed-image = Image
collada-unnamed-light = Light
collada-unnamed-camera = Camera
