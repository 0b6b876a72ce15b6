# Opening files.
document-not-found = There is no such file.
document-permission = You may not read this file.
document-folder = This is a folder, not a file.
document-not-regular = This is not a regular file.
document-empty = The file is empty.
document-io = The file could not be read: { $reason }
document-too-large = The file is larger than the limit of { NUMBER($limit, useGrouping: 0) } MiB.
document-not-text = This is not UTF-8 text; a muscle is described in a YAML file.
document-cancelled = Loading was cancelled.
document-standard-input = standard input
document-built-in = built-in biceps
document-image-missing = The image "{ $uri }" was not found; the plain colour is drawn instead.
document-image-broken = The image "{ $uri }" could not be decoded ({ $reason }); the plain colour is drawn instead.
document-clip-not-opened = The clip that the muscles are made for could not be opened ({ $error }); check “clip” in the muscle file.
document-new-muscles = new muscles
document-new-muscles-number = new muscles { $number }
