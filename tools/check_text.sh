#!/usr/bin/env bash
# Holds what no compiler checks: no include that climbs out of its folder, nothing left for later,
# no path of one machine. Prints what it finds and fails.
set -uo pipefail
cd "$(dirname "$0")/.." || exit
status=0

# forbid WHY REGEX [PATHSPEC...]
forbid() {
    local why=$1 regex=$2
    shift 2
    git grep --untracked -nIE "$regex" -- "$@" || return
    echo "check_text: $why" >&2
    status=1
}

forbid 'include headers as "part/header.h"' '#include *"\.\./'
forbid 'finish it, or say it in an issue' '\b(TO[D]O|FIX[M]E|XX[X]|HA[C]K)\b'
forbid 'a path of one machine' '(^|[^[:alnum:]_.~/-])/(home|root|Users|work|mnt)/'
exit $status
