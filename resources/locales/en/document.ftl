# Opening files.
message-verbatim = { $words }
document-not-found = There is no such file.
document-permission = You have no permission to read this file.
document-folder = This is a folder, not a file.
document-not-regular = This is not a regular file.
document-empty = The file is empty.
document-io = The file could not be read: { $reason }.
document-too-large = The file is larger than the limit of { NUMBER($limit, useGrouping: 0) } MiB.
document-not-text = This is not UTF-8 text; a muscle is described in a YAML file.
document-foreign = Sinew does not read { $format }; it reads COLLADA (.dae, .zae) and muscles (.yaml).
document-table = This is a table; a scene cannot be made from it. Measured radii are read by sinew fit and sinew measure --compare.
document-session = This is a session file; the window, sinew info and sinew render open it.
document-unknown = This file format is not known to Sinew; it reads COLLADA (.dae, .zae) and muscles (.yaml).
document-cancelled = Loading was cancelled.
document-standard-input = standard input
document-built-in = built-in biceps
document-image-missing = The image “{ $uri }”{ $count ->
        [1] {""}
       *[other] , which { NUMBER($count, useGrouping: 0) } <image> elements name,
    } was not found; the surface is drawn in a plain colour.
document-image-broken = The image “{ $uri }”{ $count ->
        [1] {""}
       *[other] , which { NUMBER($count, useGrouping: 0) } <image> elements name,
    } could not be decoded ({ $reason }); the surface is drawn in a plain colour.
document-image-reduced = { $count ->
        [1] The image “{ $uri }” has { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels and is reduced to { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
       *[other] { NUMBER($count, useGrouping: 0) } images are reduced, the first of them, “{ $uri }” of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels, to { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
    }: the limit for all images of a document is { NUMBER($limit, useGrouping: 0) } MB.
document-image-no-room = { $count ->
        [1] The image “{ $uri }” of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels is ignored
       *[other] { NUMBER($count, useGrouping: 0) } images are ignored, the first of them “{ $uri }” of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels
    }: the limit for all images of a document is { NUMBER($limit, useGrouping: 0) } MB.
document-image-decoding = The image “{ $uri }” of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels is ignored: decoding it would take more than { NUMBER($limit, useGrouping: 0) } MB.
document-image-memory = There is not enough memory for { $count ->
        [1] the image “{ $uri }”
       *[other] { NUMBER($count, useGrouping: 0) } images, the first of them “{ $uri }”
    }; the surface is drawn in a plain colour.
document-image-side = it has more than { NUMBER($limit, useGrouping: 0) } pixels per side
document-image-no-pixels = the pixel data are incomplete
document-image-colours = its colour format is not supported
document-clip-not-opened = The clip that the muscle file names could not be opened ({ $error }); check “clip” in the muscle file.
document-new-muscles = new muscles
document-new-muscles-number = new muscles { $number }

# What the system says where it refuses: the end of a sentence that says what could not be done.
io-not-found = there is no such file or folder
io-no-folder = the folder does not exist
io-denied = you have no permission
io-no-writing = you may not write in this folder
io-not-a-folder = a part of the path is not a folder
io-a-folder = it is a folder
io-read-only = the file system is read-only
io-full = the disk is full
io-quota = your disk quota is exhausted
io-memory = there is not enough memory for it
io-name = the file system does not allow this name
io-too-large = the file system allows no file of this size
io-too-many-open = too many files are open
io-link-loop = symbolic links form a cycle
io-busy = it is in use by another program
io-there-already = something with this name already exists
io-device = the device does not work correctly
io-gone = the program at the other end has stopped reading
io-cut-short = the data end too early
io-not-supported = the system does not support this here
io-slow = the answer took too long

document-yaml-several-documents = A second YAML document begins here; a file may have one. Remove this “---” and what follows, or save it as a separate file.
document-yaml-too-many-values = The file has more than { NUMBER($limit, useGrouping: 0) } values (aliases are expanded).
document-yaml-too-much-text = The texts in the file take more than { NUMBER($limit, useGrouping: 0) } MiB (aliases are expanded).
document-yaml-too-deep = Values are nested deeper than { $limit } levels here; no file needs more than ten.
document-yaml-alias-in-itself = This alias refers to a value that contains the alias.
document-yaml-syntax = This is not valid YAML: { $reason }.
document-yaml-unfitting = There is { $found } here, which is not allowed.
document-yaml-found-nothing = nothing
document-yaml-found-bool = true or false
document-yaml-found-number = a number
document-yaml-found-text = a text
document-yaml-found-list = a list
document-yaml-found-map = a group of keys
document-yaml-found-tag = a value with a tag
document-yaml-wrong-count = There are { $count } values here; another number of values is needed.
document-yaml-unknown-word = The word “{ $word }” is unknown here; known are: { $known }.
document-yaml-missing-key = The key “{ $key }” is missing here.
document-yaml-repeated-key = The key “{ $key }” occurs here for the second time; remove one of the two.
document-yaml-reason-bracket = a bracket is closed that was not opened
document-yaml-reason-escape = a quoted text contains an unknown “\” escape
document-yaml-reason-anchor = an alias “*” refers to an anchor “&” that is not defined before it
document-yaml-reason-anchor-here = an anchor “&” or alias “*” is not allowed here
document-yaml-reason-indentation = the indentation is wrong here
document-yaml-reason-directive = a “%” directive is not valid here
document-yaml-reason-tag = a “!” tag is not valid
document-yaml-reason-after = there is text after the end of the document
document-yaml-reason-colon = a “:” is not allowed here; often the indentation is wrong
document-yaml-reason-no-colon = a key has no “:”
document-yaml-reason-key = a key is expected here; often the indentation is wrong
document-yaml-reason-list = the list in “[ ]” is not closed, or a comma is missing
document-yaml-reason-map = the map in “{"{"} {"}"}” is not closed, or a comma is missing
document-yaml-reason-dash = a “-” is expected here; often the indentation is wrong
document-yaml-reason-dash-here = a list cannot begin with “-” here
document-yaml-reason-character = this character is not allowed here; a tab cannot indent
document-yaml-reason-end = the file ends inside a quoted text
document-yaml-reason-control = an invisible control character
document-yaml-reason-content = a value is expected here
document-too-many-files = The session names { $count } files; the limit is { $limit }.
document-too-much-surface = With this file the surfaces of all muscles would have more than { NUMBER($limit, useGrouping: 0) } vertices, which is the limit for drawing.
document-unnamed-animation = Animation
document-unnamed-scene = Scene
document-unnamed-clip = Clip { $number }
document-unnamed-node = Node { $number }
document-unnamed-mesh = Mesh
document-unnamed-skin = Skin
document-unnamed-morph = Morph
document-unnamed-material = Material
document-unnamed-image = Image
document-unnamed-light = Light
document-unnamed-camera = Camera
document-muscle-outside-skin = The muscle lies outside of the skin that its bones move, so that the skin does not follow it.
