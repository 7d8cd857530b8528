# shellcheck shell=bash
# Sourced by ./dev: installs Debian packages where they are missing.

# packages SET...: the packages of these sets of packages.txt, one a line.
packages() {
    awk -v sets=" $* " '
        /^\[/ { wanted = index(sets, " " substr($1, 2, length($1) - 2) " ") }
        wanted && /^[a-z0-9]/ { print $1 }' tools/packages.txt | LC_ALL=C sort -u
}

installed_packages() {
    dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | LC_ALL=C sort -u
}

as_root() {
    if [ "$(id -u)" = 0 ]; then env "$@"; else sudo env "$@"; fi
}

# need SET...: installs what is missing of these sets; without the network where nothing is.
need() {
    if ! command -v apt-get > /dev/null; then
        echo "dev: no apt-get here; these Debian 12 packages, or their like, must be there:" \
            "$(packages "$@" | tr '\n' ' ')" >&2
        return
    fi
    local missing
    missing=$(LC_ALL=C comm -23 <(packages "$@") <(installed_packages))
    [ -n "$missing" ] || return 0
    echo "dev: installing ${missing//$'\n'/ }"
    local try
    for try in 1 2 3; do
        as_root apt-get -q -o APT::Update::Error-Mode=any update && break
        echo "dev: apt-get update failed ($try of 3)" >&2
        sleep $((try * 5))
    done
    # shellcheck disable=SC2086  # one word a package
    as_root DEBIAN_FRONTEND=noninteractive \
        apt-get -q -o Acquire::Retries=3 install -y --no-install-recommends $missing
}
