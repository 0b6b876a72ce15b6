# collada: why a file is refused
collada-too-large = The file is larger than the limit of { $limit } MB.
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
collada-xml-cut-short = The XML is incomplete: the file is truncated.
collada-xml-unknown-entity = The XML uses the entity &{ $name };, which is not declared.
collada-xml-entity-loop = The XML’s entities refer to each other in a cycle.
collada-xml-unknown-prefix = The XML uses the namespace prefix “{ $prefix }”, which is not declared.
collada-xml-repeated-attribute = An element has the attribute “{ $name }” twice.
collada-archive-broken = The archive is damaged and cannot be unpacked.
collada-archive-files = The archive holds more than { $limit } files.
collada-archive-large = The unpacked archive would exceed the memory limit: { $limit } times its size plus 64 MB. Unpack it and open the document that it contains.
collada-archive-empty = The archive holds no COLLADA document.
collada-archive-root = The archive’s manifest names “{ $path }”, which is not in the archive.

# collada: diagnostics
collada-encoding = The bytes are not valid { $named }; the file is read as Windows-1252, so some letters in names may be wrong.
collada-unknown-version = Version “{ $version }” is unknown; the file is read as 1.4.1.
collada-bad-unit = The unit “{ $value }” is not a positive number; 1 metre is used.
collada-bad-up-axis = The up axis “{ $value }” is none of X_UP, Y_UP, Z_UP; Y_UP is used.
collada-repeated-id = Another element has the same id; references lead to the nearest element of the right kind.
collada-undeclared-prefix = The namespace prefix “{ $prefix }” is not declared anywhere; names are read without it.
collada-broken-reference = The element “{ $target }” that this reference names is not in the file; the reference is ignored.
collada-wrong-reference = This reference leads to “{ $target }”, a <{ $tag }>, which is of the wrong kind; the reference is ignored.
collada-external-reference = This reference leads to another file, “{ $file }”, which is not loaded.
collada-part-broken = This document of the archive cannot be read: { $reason }
collada-part-entities = It declares entities, which are not supported in this document.
collada-reference-cycle = The references form a cycle; this reference is ignored.
collada-decimal-comma = Numbers have a decimal comma, the first is “{ $entry }”; the comma is read as a decimal point.
collada-bad-number = { $count ->
    [one] “{ $first }” is not a number; 0 is used.
   *[other] { $count } entries are not numbers, the first is “{ $first }”; 0 is used.
}
collada-not-finite = A value is infinite or not a number; it is ignored.
collada-not-finite-points = Positions are infinite or not numbers; faces that use them are not drawn.
collada-not-finite-keys = Keyframes are infinite or not numbers; they are ignored.
collada-count-mismatch = The attribute count is { $said }, the data contain { $found }; the count is ignored.
collada-index-out-of-range = { $count ->
    [one] One face has an index outside its lists; it is ignored.
   *[other] { $count } faces have indices outside their lists; they are ignored.
}
collada-values-out-of-range = { $count ->
    [one] One vertex has an index outside its lists of normals, texture coordinates or colours; it is drawn without this value, its normal is computed.
   *[other] { $count } vertices have indices outside their lists of normals, texture coordinates or colours; they are drawn without these values, their normals are computed.
}
collada-not-finite-values = { $count ->
    [one] One vertex has a normal, texture coordinate or colour that is infinite or not a number; it is drawn without this value, its normal is computed.
   *[other] { $count } vertices have normals, texture coordinates or colours that are infinite or not numbers; they are drawn without these values, their normals are computed.
}
collada-not-finite-weights = { $count ->
    [one] One weight is infinite or not a number; it is ignored.
   *[other] { $count } weights are infinite or not numbers; they are ignored.
}
collada-no-faces = The mesh has no faces and no lines, so there is nothing to draw.
collada-empty-list = The list is empty; indices into it are ignored.
collada-incomplete-primitive = { $count ->
    [one] One face has too few vertices; it is ignored.
   *[other] { $count } faces have too few vertices; they are ignored.
}
collada-polygon-too-complex = { $count ->
    [one] One polygon is too complex to be triangulated; it is ignored.
   *[other] { $count } polygons are too complex to be triangulated; they are ignored.
}
collada-no-positions = The mesh has no vertex positions and is not drawn.
collada-unsupported-geometry = Geometry of the kind <{ $kind }> is not supported.
collada-too-many-uv-sets = The mesh has more than { $limit } sets of texture coordinates; the others are ignored.
collada-no-scene-named = The file names no scene to show; the first one is shown.
collada-no-scene = The file has no scene; its geometry is shown without one.
collada-bottom-row = The last row of a matrix is not 0 0 0 1; it is replaced by 0 0 0 1.
collada-bad-transform = The transform needs { $wanted } numbers and has { $found }; it is ignored.
collada-unsupported-element = <{ $element }> is not supported: kinematics and formulas have no effect.
collada-limit-nodes = The scene has more than { $nodes } nodes or more than { $depth } levels; the rest is ignored.
collada-morph-depth = Morph targets refer to one another over more than { $limit } levels; deeper levels are ignored.
collada-limit-reached = The scene exceeds the limit for a file of this size; the rest is ignored.
collada-limit-drawn = Drawing all instances would take more than { $limit } MB; the other instances are ignored.
collada-joint-not-found = { $count ->
    [one] The joint “{ $first }” is not in the scene; it stays in its bind pose.
   *[other] { $count } joints are not in the scene, the first is “{ $first }”; they stay in their bind pose.
}
collada-bind-scale = The skin “{ $skin }” and its bones do not match in the rest pose: the inverse bind matrix of joint “{ $joint }” scales the skin by { $factor }, and no node compensates for this scale.
collada-bind-node-scale = The skin “{ $skin }” and its bones do not match in the rest pose: joint “{ $joint }” scales the skin by { $factor } relative to the node that holds it, and the transform of this node does not apply to a skin.
collada-bind-node-turn = The skin “{ $skin }” and its bones do not match in the rest pose: joint “{ $joint }” rotates the skin by { $angle }° relative to the node that holds it, and the transform of this node does not apply to a skin.
collada-skeleton-not-in-scene = The skeleton is not part of the scene; it was added to the scene.
collada-joint-names-rejoined = Joint names contain blanks; the parts of each name were joined.
collada-joint-count = There are { $names } joint names and { $matrices } inverse bind matrices; joints without one of the two are ignored.
collada-bad-skin = The skin has no usable { $what }; the mesh is shown without the skin.
collada-no-weights = The skin has no usable WEIGHT; the mesh keeps its bind shape.
collada-no-inverse-bind = The skin has no usable INV_BIND_MATRIX; identity matrices are used.
collada-second-skin = The mesh has a skin over a skin; only the inner skin is used.
collada-nothing-to-show = The file has no scene and no geometry: nothing can be shown.
collada-stride-mismatch = The attribute stride is { $said }, the params need { $found }; { $found } is used.
collada-skin-points = The weights cover { $found } vertices, the mesh has { $wanted }; vertices without weights keep their bind shape.
collada-influences-out-of-range = { $count ->
    [one] One weight has an index of a joint or value that does not exist; it is ignored.
   *[other] { $count } weights have indices of joints or values that do not exist; they are ignored.
}
collada-influences-missing = { $count ->
    [one] One weight is missing at the end of the list.
   *[other] { $count } weights are missing at the end of the list.
}
collada-weights-not-normalised = { $count ->
    [one] The weights of one vertex do not add up to 1; they are normalised.
   *[other] The weights of { $count } vertices do not add up to 1; they are normalised.
}
collada-empty-controller = The controller has neither a skin nor a morph; it is ignored.
collada-bad-morph = The morph has no list of targets; it is ignored.
collada-morph-weights = The morph has fewer weights than targets; the missing weights are 0.
collada-morph-target = The morph target “{ $target }” has { $found } vertices, the base mesh { $wanted }; the target is ignored.
collada-unknown-target = The channel animates “{ $target }”, which is not in the scene; the channel is ignored.
collada-unsupported-target = The channel animates “{ $target }”, whose animation is not supported; the channel is ignored.
collada-bad-sampler = The sampler has no usable times or values; it is ignored.
collada-key-counts = There are { $times } times and { $values } values; keyframes without one of the two are ignored.
collada-key-size = Each keyframe has { $found } numbers, { $wanted } are needed; the keyframes are ignored.
collada-unsupported-interpolation = The interpolation { $name } is not supported; LINEAR is used.
collada-missing-tangents = BEZIER or HERMITE keyframes have no usable tangents; LINEAR is used.
collada-sheared-keys = Matrix keyframes contain shear; they are interpolated element by element.
collada-empty-clip = The clip contains no animation; it is ignored.
collada-unbound-material = The material symbol “{ $symbol }” of the mesh is not bound; a neutral material is used.
collada-texture-not-found = The texture “{ $name }” leads to no image; it is ignored.
collada-no-common-profile = The effect has no common profile; a neutral material is used.
collada-transparency-inverted = Taken literally, the transparency makes the material invisible; it is inverted.
collada-bad-light = The kind of the light is unknown; the light is ignored.
collada-bad-camera = The camera has no projection; it is ignored.
finding-more-places = { $count ->
    [one] The same once more in this file.
   *[other] The same { $count } times more in this file.
}
collada-more-findings = { $count ->
    [one] There is one more problem; only the first { $limit } are listed.
   *[other] There are { $count } more problems; only the first { $limit } are listed.
}
