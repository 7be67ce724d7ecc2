#!/bin/sh
# run.sh PROGRAM ARGUMENT...: runs an example in a folder of its own. It must print "yes" and never "no", and
# the pictures that it names must exist.
program=$(realpath "$1") || exit 1
shift
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
# Where the library is built with ASan, the program is not, and it does not free its arrays.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}verify_asan_link_order=0:detect_leaks=0"
"$program" "$@" >said || { cat said; exit 1; }
cat said
grep -q ': yes' said || { echo "it did not say yes"; exit 1; }
! grep -q ': no' said || exit 1
for picture in $(sed -n 's/^picture: //p' said); do
    [ -s "$picture" ] || { echo "there is no $picture"; exit 1; }
done
