#!/bin/sh
# Runs a program's kernels under oclgrind: any bad access or race fails the test. Uninitialised values are not
# looked for: the padding of rows holds them by design, and they stay in it.
#     oclgrind.sh PROGRAM
if ! command -v oclgrind >/dev/null; then
    echo "skipped: oclgrind is not installed"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$work/log
# its own kernels, not what another device has cached
LUTETIA_DEVICE=Oclgrind XDG_CACHE_HOME=$work oclgrind --data-races --log "$log" "$@"
status=$?
if [ -s "$log" ]; then
    cat "$log"
    exit 1
fi
exit $status
