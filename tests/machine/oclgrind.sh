#!/bin/sh
# Runs a program's kernels under oclgrind: any bad access or race fails the test. It does not check for uninitialised
# values, because the padding of rows holds some by design, and they stay there.
#     oclgrind.sh PROGRAM
if ! command -v oclgrind >/dev/null; then
    echo "skipped: oclgrind is not installed"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
# its own kernels, not those that another device has cached
LUTETIA_DEVICE=Oclgrind XDG_CACHE_HOME=$work oclgrind --data-races --log "$log" "$@"
status=$?
if [ -s "$log" ]; then
    cat "$log"
    exit 1
fi
exit $status
