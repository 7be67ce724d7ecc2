#!/bin/sh
# Runs a program's kernels under oclgrind: any bad access, use of uninitialised memory or race fails the test.
#     oclgrind.sh PROGRAM
if ! command -v oclgrind >/dev/null; then
    echo "skipped: oclgrind is not installed"
    exit 77
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# its own kernels, not what another device has cached
LUTETIA_DEVICE=Oclgrind XDG_CACHE_HOME=$(mktemp -d) oclgrind --uninitialized --data-races --log "$log" "$@"
status=$?
if [ -s "$log" ]; then
    cat "$log"
    exit 1
fi
exit $status
