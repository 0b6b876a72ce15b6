# Opening files.
message-verbatim = { $words }
document-not-found = There is no such file.
document-permission = You may not read this file.
document-folder = This is a folder, not a file.
document-not-regular = This is not a regular file.
document-empty = The file is empty.
document-io = The file could not be read: { $reason }.
document-too-large = The file is larger than the limit of { NUMBER($limit, useGrouping: 0) } MiB.
document-not-text = This is not UTF-8 text; a muscle is described in a YAML file.
document-foreign = Sinew does not read { $format }; it reads COLLADA (.dae, .zae) and muscles (.yaml).
document-table = This is a table, and nothing in it can be shown; measured radii are for sinew fit and sinew measure --compare.
document-session = This is a session; the window, sinew info and sinew render open it.
document-unknown = Sinew does not know this kind of file; it reads COLLADA (.dae, .zae) and muscles (.yaml).
document-cancelled = Loading was cancelled.
document-standard-input = standard input
document-built-in = built-in biceps
document-image-missing = The image "{ $uri }"{ $count ->
        [1] {""}
       *[other] , which { NUMBER($count, useGrouping: 0) } <image> elements name,
    } was not found; the plain colour is drawn instead.
document-image-broken = The image "{ $uri }"{ $count ->
        [1] {""}
       *[other] , which { NUMBER($count, useGrouping: 0) } <image> elements name,
    } could not be decoded ({ $reason }); the plain colour is drawn instead.
document-image-reduced = { $count ->
        [1] The image "{ $uri }" has { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels and is drawn with { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
       *[other] { NUMBER($count, useGrouping: 0) } images are drawn smaller than they are, the first of them, "{ $uri }" of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels, with { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
    }: all images of a document together may take { NUMBER($limit, useGrouping: 0) } MB.
document-image-no-room = { $count ->
        [1] The image "{ $uri }" of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels is left out
       *[other] { NUMBER($count, useGrouping: 0) } images are left out, the first of them "{ $uri }" of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels
    }: all images of a document together may take { NUMBER($limit, useGrouping: 0) } MB.
document-image-decoding = The image "{ $uri }" of { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } pixels is left out: decoding it would take more than { NUMBER($limit, useGrouping: 0) } MB.
document-image-memory = There is not enough memory for { $count ->
        [1] the image "{ $uri }"
       *[other] { NUMBER($count, useGrouping: 0) } images, the first of them "{ $uri }"
    }; the plain colour is drawn instead.
document-image-side = it has more than { NUMBER($limit, useGrouping: 0) } pixels a side
document-image-no-pixels = pixels are missing
document-image-colours = its kind of colours is not known
document-clip-not-opened = The clip that the muscles are made for could not be opened ({ $error }); check “clip” in the muscle file.
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
io-quota = your share of the disk is used up
io-memory = there is not enough memory for it
io-name = the file system does not allow this name
io-too-large = the file system allows no file of this size
io-too-many-open = too many files are open
io-link-loop = symbolic links lead round in a circle
io-busy = it is in use by another program
io-there-already = something of this name is there already
io-device = the device does not work as it should
io-gone = whoever was to take it has stopped reading
io-cut-short = it ends too early
io-not-supported = the system cannot do this here
io-slow = the answer took too long

document-yaml-several-documents = A second document begins here; the file has one. Remove this “---” and what follows, or save it as a file of its own.
document-yaml-too-many-values = The file has more than { NUMBER($limit, useGrouping: 0) } values, aliases counted each time.
document-yaml-too-much-text = The texts in the file are more than { NUMBER($limit, useGrouping: 0) } MiB, aliases counted each time.
document-yaml-too-deep = Values nest deeper than { $limit } levels here; no file needs more than ten.
document-yaml-alias-in-itself = This alias stands inside the value that it stands for.
document-yaml-syntax = This is not valid YAML: { $reason }.
document-yaml-unfitting = There is { $found } here, which does not fit.
document-yaml-found-nothing = nothing
document-yaml-found-bool = true or false
document-yaml-found-number = a number
document-yaml-found-text = a text
document-yaml-found-list = a list
document-yaml-found-map = a group of keys
document-yaml-found-tag = a value with a tag
document-yaml-wrong-count = There are { $count } values here, which is not the number that belongs here.
document-yaml-unknown-word = There is no “{ $word }” here; known are: { $known }.
document-yaml-missing-key = The key “{ $key }” is missing here.
document-yaml-repeated-key = The key “{ $key }” stands here for the second time; remove one of the two.
document-yaml-reason-bracket = a bracket is closed that was not opened
document-yaml-reason-escape = an unknown “\” code in a text in quotes
document-yaml-reason-anchor = an alias “*” of something that is not marked with “&” before
document-yaml-reason-anchor-here = an “&” or “*” stands where none can be
document-yaml-reason-indentation = the indentation is wrong here
document-yaml-reason-directive = a “%” line that is wrong here
document-yaml-reason-tag = a “!” tag that is wrong
document-yaml-reason-after = something stands after the end of the document
document-yaml-reason-colon = a “:” stands where no key can be, often because of the indentation
document-yaml-reason-no-colon = a key without its “:”
document-yaml-reason-key = a key was expected here, often because of the indentation
document-yaml-reason-list = the list in “[ ]” is not closed, or a comma is missing
document-yaml-reason-map = the map in “{"{"} {"}"}” is not closed, or a comma is missing
document-yaml-reason-dash = a “-” was expected here, often because of the indentation
document-yaml-reason-dash-here = a “-” stands where no list can begin
document-yaml-reason-character = a character that cannot stand here; a tab does not indent
document-yaml-reason-end = the text ends in the middle of something quoted
document-yaml-reason-control = an invisible control character
document-yaml-reason-content = a value was expected here
document-too-many-files = The session names { $count } files; at most { $limit } are opened together.
document-too-much-surface = With this file the surfaces of all muscles would have more than { NUMBER($limit, useGrouping: 0) } vertices together, which is the most that is drawn.
