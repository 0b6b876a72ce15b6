#!/bin/sh
# Draws the pictures of the skin that follows muscles: resources/pictures/skin.gif, the demo arm that bends and stretches, its skin opaque and transparent;
# skin-before-after.png, the arm bent by its skeleton alone and with its skin following. The program draws the frames, ImageMagick crops and joins them.
set -eu
cd "$(dirname "$0")/.."
sinew=${1:-target/release/sinew}
pictures=resources/pictures
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT

# 27 frames, 5 degrees apart, from the front and the inner side, where the biceps lies. One camera for all: the frames of a sweep have it, single images have not.
draw() {
    name=$1
    shift
    "$sinew" render configs/curl-muscles.yaml --quiet --sweep-angle 0:130 --duration 1.3 --fps 20 --yaw 40 --pitch 8 --light 0.2,2.5,1.5 \
        --background '#20242c' --size 1800x1800 "$@" -o "$frames/$name-%02d.png"
}
draw follows --no-see-through
draw transparent
draw skeleton --no-see-through --no-skin-follow
UPPER_ARM=580x760+390+220

# There and back again; each end is there once.
for frame in "$frames"/follows-*.png; do
    number=${frame##*-}
    convert "$frame" "$frames/transparent-$number" -crop $UPPER_ARM +repage +append -resize 45% "$frames/film-$number"
done
there=$(ls "$frames"/film-*.png)
back=$(ls -r "$frames"/film-*.png | sed '1d;$d')
# shellcheck disable=SC2086
convert -delay 5 $there $back +dither -colors 96 -loop 0 -layers optimize "$pictures/skin.gif"

# At 65 degrees.
convert "$frames/skeleton-13.png" "$frames/follows-13.png" -crop $UPPER_ARM +repage +append -resize 75% "$pictures/skin-before-after.png"
ls -l "$pictures/skin.gif" "$pictures/skin-before-after.png"
