#!/usr/bin/env bash
# Headers and libraries of another Debian architecture, for building and testing what runs there:
# build/sysroot/ARCH, made again only when the list of packages changes.
#
# usage: tools/sysroot.sh ARCH...     (arm64, armhf)
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

# The virtual scanner and the thesis' pipeline stay on the development machine.
not_on_the_device='libembree-dev|libqhull-dev'

# Every other library to build and to test with.
sysroot_packages() {
    packages build test | grep -e '-dev$' | grep -vxE "$not_on_the_device"
}

# The machine's own sources of Debian, as one-line entries; other vendors' stay out. So do security
# updates: nothing of a sysroot runs but tests, and their armhf index is at times not the one that
# its release file promises.
debian_sources() {
    # shellcheck disable=SC2016  # apt fills the $( ) in
    apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
        'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sort -u
}

# How the machine reaches them: proxies and the like.
apt_options() {
    apt-config dump | grep -E '^Acquire::https?::' || true
    echo 'Acquire::Retries "3";'
}

# extract ARCH FOLDER: without running anything of the packages, and without what no build reads.
extract() {
    local arch=$1 folder=$2
    mkdir -p "$folder"
    debian_sources | as_root mmdebstrap --quiet --variant=extract --format=tar \
        --architectures="$arch" --include="$(sysroot_packages | paste -sd,)" \
        --aptopt="$(apt_options)" "$VERSION_CODENAME" - - |
        tar -x -C "$folder" --no-same-owner --exclude='./dev' --exclude='./usr/share/doc' \
            --exclude='./usr/share/man' --exclude='./usr/share/locale' --exclude='./var'
}

# Absolute links would lead out of the sysroot.
relative_links() {
    find "$1" -type l -lname '/*' -printf '%p\t%l\n' | while IFS=$'\t' read -r link target; do
        ln -sfnr "$1$target" "$link"
    done
}

# sysroot ARCH
sysroot() {
    local arch=$1 folder=build/sysroot/$1 list=build/sysroot/$1.packages try
    if [ -e "$folder" ] && sysroot_packages | cmp -s - "$list"; then return; fi
    echo "sysroot: making $folder"
    [ -n "$(debian_sources)" ] || as_root apt-get -q update
    # An index that is being renewed on its server fails its hash check for a while.
    for try in 1 2 3 4 5; do
        rm -rf "$folder" "$list" "$folder.new"
        if extract "$arch" "$folder.new"; then
            relative_links "$folder.new"
            mv "$folder.new" "$folder"
            sysroot_packages > "$list"
            return
        fi
        echo "sysroot: $arch failed ($try of 5)" >&2
        sleep $((try * 5))
    done
    return 1
}

. /etc/os-release
for arch in "$@"; do
    case $arch in
        arm64 | armhf) sysroot "$arch" ;;
        *) echo "sysroot: no architecture '$arch': arm64 or armhf" >&2; exit 64 ;;
    esac
done
