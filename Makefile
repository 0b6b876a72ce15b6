# Sinew: `make run` to try it, `make test` to check it, `make install PREFIX=…` to keep it.
# `run` and `test` install what is missing: Rust, and on Debian and its kin the system packages (resources/setup.sh says which and why). They say so
# first, and ask about Rust at a terminal; with SINEW_NO_INSTALL=1 they install nothing.

PREFIX ?= /usr/local
DESTDIR ?=
CARGO ?= resources/cargo.sh

ID := io.github.sinew.Sinew
# Where cargo builds, should the user have said so.
TARGET := $(or $(CARGO_TARGET_DIR),target)
BINARY := $(TARGET)/release/sinew
SHARE = $(DESTDIR)$(PREFIX)/share
ICONS = $(SHARE)/icons/hicolor
MIME_CACHES := XMLnamespaces aliases generic-icons globs globs2 icons magic mime.cache subclasses treemagic types version
COMPLETIONS = "$(SHARE)/bash-completion/completions/sinew" "$(SHARE)/zsh/site-functions/_sinew" "$(SHARE)/fish/vendor_completions.d/sinew.fish"

.PHONY: run build test test-newer soak monkey shots plots bench fuzz install uninstall deb clean refresh clips walker-muscles pictures

# The window starts with this biceps; without a display it is drawn instead.
START := configs/biceps-measured.yaml

run: build
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then \
	    exec $(BINARY); \
	else \
	    mkdir -p out && $(BINARY) render $(START) -o out/start.png && \
	    echo "There is no display here, so the start scene was drawn to $(CURDIR)/out/start.png"; \
	fi

build:
	@resources/setup.sh build
	$(CARGO) build --release --locked

# Drivers of the window that failed once are listed there (tests/window.rs).
UNSTEADY := $(TARGET)/tmp/unsteady

# Properties are tested on the same random inputs at each run, so that a failure is about the change at hand; `make soak` takes new ones.
test: export PROPTEST_RNG_SEED := 20261130
test:
	@echo "== System packages"
	@resources/setup.sh test
	@echo "== Format"
	$(CARGO) fmt --all --check
	@echo "== Desktop files"
	@resources/check-desktop.sh
	@echo "== Lints, with the window"
	$(CARGO) clippy --locked --workspace --all-targets -- -D warnings
	@echo "== Lints, without the window"
	$(CARGO) clippy --locked --workspace --all-targets --no-default-features -- -D warnings
	@echo "== Documentation"
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --workspace --no-deps
	@echo "== Tests"
	@rm -f $(UNSTEADY)
	$(CARGO) test --locked --workspace
	@if [ -s $(UNSTEADY) ]; then echo "== Unsteady: failed once, then passed twice"; cat $(UNSTEADY); fi
	@echo "== All checks passed"

# Random events on the window in Debian 13, with its GTK 4.18, or with NEWER=name another driver: a root of its own, by debootstrap, as root.
test-newer:
	@resources/setup.sh newer
	resources/test-newer.sh $(NEWER)

# Each property on that many new random inputs; takes about a quarter of an hour. What fails is printed with its input.
SOAK_CASES ?= 3000
soak: export PROPTEST_CASES := $(SOAK_CASES)
soak:
	@resources/setup.sh test
	$(CARGO) test --locked --workspace --no-fail-fast --lib $(patsubst tests/%/main.rs,--test %,$(wildcard tests/*/main.rs))

# Ten thousand random keys, clicks and drags on the window, with a window manager and without; takes minutes.
monkey:
	@resources/setup.sh test
	$(CARGO) test --locked --test window -- --ignored --nocapture --test-threads 1 ten_thousand

# Pictures of the main views in both languages and both styles, to look at: out/shots.
shots:
	@resources/setup.sh test
	SINEW_SHOTS="$(CURDIR)/out/shots" $(CARGO) test --locked --test window -- --ignored --nocapture main_views
	@echo "The pictures are in $(CURDIR)/out/shots"

# The plot of the README: the moment arms of the presets over those of Arm26.
PRESETS := configs/biceps-human-wrapped.yaml configs/brachialis-human.yaml configs/triceps-human.yaml
plots: build
	$(BINARY) measure $(PRESETS) --sweep 0:130:1 --plot resources/pictures/moment-arms.png --published --force

# Set beside two rasterizers in Rust, beside assimp and f3d where they are installed, and beside Mesa's llvmpipe where Mesa and Python are.
PEERS := $(TARGET)/peers
SCENES ?= configs/walker.dae
bench: build
	$(CARGO) bench --locked
	$(BINARY) bench
	@if command -v assimp >/dev/null; then python3 benches/peers/assimp.py $(BINARY); else echo "assimp was not measured (Debian: assimp-utils)"; fi
	$(CARGO) run --release --locked --quiet --manifest-path benches/peers/Cargo.toml --target-dir $(PEERS) -- $(BINARY)
	@if python3 -m venv $(PEERS) && $(PEERS)/bin/pip --quiet install moderngl==5.13.0 numpy; then \
	    $(PEERS)/bin/python benches/peers/llvmpipe.py $(BINARY) || echo "llvmpipe could not be measured (Debian: libgl1-mesa-dri libegl1 libgl1)"; \
	else \
	    echo "llvmpipe was not measured: it needs python3-venv"; \
	fi
	@python3 benches/peers/f3d.py $(BINARY) $(SCENES)

# Throws altered files at the readers, each target for so many minutes; the corpus grows from run to run. What is found lies in tests/fuzz/artifacts.
FUZZ_TARGETS ?= collada muscles render sessions settings
FUZZ_MINUTES ?= 30
FUZZ_OPTIONS ?= -timeout=25 -rss_limit_mb=1024 -max_len=24576
CORPUS := tests/fuzz/target/corpus
fuzz:
	@$(CARGO) fuzz --version >/dev/null 2>&1 || { echo "Fuzzing needs cargo-fuzz: cargo install cargo-fuzz --locked"; exit 1; }
	@mkdir -p $(CORPUS)/collada && cp configs/*.dae tests/fuzz/seeds/collada/* $(CORPUS)/collada
	@mkdir -p $(CORPUS)/muscles && cp configs/*.yaml tests/fuzz/seeds/muscles/* $(CORPUS)/muscles
	@mkdir -p $(CORPUS)/sessions && cp tests/fuzz/seeds/sessions/* $(CORPUS)/sessions
	@mkdir -p $(CORPUS)/settings && cp tests/fuzz/seeds/settings/* $(CORPUS)/settings
	@for target in $(FUZZ_TARGETS); do \
	    case $$target in sessions|settings) words=yaml ;; *) words=collada ;; esac; \
	    mkdir -p $(CORPUS)/$$target && \
	    $(CARGO) fuzz run -s none --fuzz-dir tests/fuzz $$target $(CORPUS)/$$target -- \
	        -dict=tests/fuzz/$$words.dict -max_total_time=$$(( $(FUZZ_MINUTES) * 60 )) $(FUZZ_OPTIONS) || exit 1; \
	done

# Built beforehand as oneself, installed as root: `make build && sudo make install`.
install:
	@[ -x $(BINARY) ] || $(MAKE) --no-print-directory build
	install -Dm755 $(BINARY) "$(DESTDIR)$(PREFIX)/bin/sinew"
	install -Dm755 $(BINARY)-window "$(DESTDIR)$(PREFIX)/bin/sinew-window"
	install -Dm644 resources/icons/$(ID).svg "$(ICONS)/scalable/apps/$(ID).svg"
	install -Dm644 resources/icons/$(ID)-symbolic.svg "$(ICONS)/symbolic/apps/$(ID)-symbolic.svg"
	install -Dm644 resources/$(ID).desktop "$(SHARE)/applications/$(ID).desktop"
	install -Dm644 resources/$(ID).metainfo.xml "$(SHARE)/metainfo/$(ID).metainfo.xml"
	install -Dm644 resources/$(ID)-mime.xml "$(SHARE)/mime/packages/$(ID).xml"
	install -Dm644 resources/sinew.thumbnailer "$(SHARE)/thumbnailers/sinew.thumbnailer"
	install -Dm644 resources/sinew.1 "$(SHARE)/man/man1/sinew.1"
	@# An interface of the user's own language would be no use to others: completions are installed in English.
	install -d "$(SHARE)/bash-completion/completions" "$(SHARE)/zsh/site-functions" "$(SHARE)/fish/vendor_completions.d"
	LC_ALL=C.UTF-8 $(BINARY) completions bash > $(word 1,$(COMPLETIONS))
	LC_ALL=C.UTF-8 $(BINARY) completions zsh > $(word 2,$(COMPLETIONS))
	LC_ALL=C.UTF-8 $(BINARY) completions fish > $(word 3,$(COMPLETIONS))
	@$(MAKE) --no-print-directory refresh

uninstall:
	rm -f "$(DESTDIR)$(PREFIX)/bin/sinew" "$(DESTDIR)$(PREFIX)/bin/sinew-window" \
	    "$(ICONS)/scalable/apps/$(ID).svg" "$(ICONS)/symbolic/apps/$(ID)-symbolic.svg" \
	    "$(SHARE)/applications/$(ID).desktop" "$(SHARE)/metainfo/$(ID).metainfo.xml" \
	    "$(SHARE)/mime/packages/$(ID).xml" "$(SHARE)/thumbnailers/sinew.thumbnailer" "$(SHARE)/man/man1/sinew.1" $(COMPLETIONS)
	@$(MAKE) --no-print-directory refresh
	@# Where nothing else was installed, the caches are about nothing any more.
	@none() { ! ls "$$@" >/dev/null 2>&1; }; \
	if none "$(SHARE)"/mime/packages/*; then \
	    for cache in $(MIME_CACHES); do rm -f "$(SHARE)/mime/$$cache"; done; \
	fi; \
	if none "$(SHARE)"/applications/*.desktop; then rm -f "$(SHARE)/applications/mimeinfo.cache"; fi; \
	if none "$(ICONS)"/*/*/*; then rm -f "$(ICONS)/icon-theme.cache"; fi

# A Debian package in out/deb/, from what is built.
deb: build
	rm -rf out/deb
	$(MAKE) --no-print-directory install DESTDIR="$(CURDIR)/out/deb/root" PREFIX=/usr
	resources/deb.sh out/deb

# The desktop's caches; a package (DESTDIR) leaves them to its own installer.
refresh:
	@call() { if command -v "$$1" >/dev/null; then "$$@"; fi; }; \
	if [ -z "$(DESTDIR)" ] && [ -d "$(SHARE)/mime/packages" ]; then \
	    call update-mime-database "$(SHARE)/mime"; \
	    call update-desktop-database -q "$(SHARE)/applications"; \
	    call gtk4-update-icon-cache -qtf "$(ICONS)"; \
	fi

# Makes the clips of configs/ again, with Debian 12's Blender; one thread, so that the same bytes come out.
BLENDER ?= blender --background --threads 1 --factory-startup --python-exit-code 1
clips:
	$(BLENDER) --python resources/blender/curl.py
	$(BLENDER) --python resources/blender/atlas.py
	$(BLENDER) --python resources/blender/walker.py
	python3 resources/blender/lamp.py

# Makes the walker's muscles again, and their film in README.md.
walker-muscles: build
	$(BINARY) attach configs/walker.dae --set body -o configs/walker-muscles.yaml --force
	$(BINARY) render configs/walker-muscles.yaml -o resources/pictures/walker-muscles.gif --size 300x400 --fps 15 --yaw 40 --pitch 4 --zoom 1.1 --force

# Draws the film and the picture of the skin that follows muscles again: resources/pictures.
pictures: build
	@resources/setup.sh test
	resources/pictures.sh $(BINARY)

clean:
	$(CARGO) clean
	rm -rf out
