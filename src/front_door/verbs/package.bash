# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam package                    build Debian packages of the last commit in build/package, and let
#|                                    lintian look at them

readonly package_packages=(build-essential debhelper dpkg-dev fakeroot git help2man lintian xz-utils
    dh-python pybind11-dev python3-dev python3-numpy)

# The sources as git archives them, with src/package/debian where dpkg looks for it.
unpack() { # version, folder
    local debian=$2/spam-$1/debian
    git -C "$root" archive --prefix="spam-$1/" HEAD | xz -T0 >"$2/spam_$1.orig.tar.xz"
    tar -C "$2" -xf "$2/spam_$1.orig.tar.xz"
    cp -a "$2/spam-$1/src/package/debian" "$debian"
    mkdir "$debian/missing-sources"
    cp "$2/spam-$1"/src/package/vendor/*.js "$debian/missing-sources"
}

verb_package() {
    local version folder=$root/build/package
    (($# == 0)) || refuse "package: '$1'? It knows no options"
    preset=package
    lock
    install_packages "${build_packages[@]}" "${package_packages[@]}"
    need package dpkg-buildpackage dpkg-dev
    need package dh debhelper
    need package help2man help2man
    need package lintian lintian
    need package git git
    [[ -z $(git -C "$root" rev-parse --show-prefix 2>&1) ]] ||
        stop package "$root is no git repository of its own" "clone SPAM and call ./spam package there"
    [[ -z $(git -C "$root" status --porcelain) ]] || say "package: what is not committed stays out"
    version=$(git -C "$root" show HEAD:CMakeLists.txt | sed -n 's/^project(spam VERSION \([0-9.]*\).*/\1/p')
    find "$folder" -mindepth 1 -maxdepth 1 ! -name '*.log' ! -name spam.lock -exec rm -r {} +
    unpack "$version" "$folder"
    step build "building packages in build/package" '^\[|^dh_|^dpkg-' env -C "$folder/spam-$version" -u CI \
        LC_ALL=C.UTF-8 dpkg-buildpackage -us -uc || fail build "mend the error above"
    # Whose packages they are says who publishes them; the address in debian/control is nobody's.
    step lintian "letting lintian look" . lintian --fail-on error,warning --allow-root \
        --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$folder"/*.changes ||
        fail lintian "mend what it complains of in src/package/debian"
    unlock
    say "packages:"
    find "$folder" -maxdepth 1 -name '*.deb' ! -name '*-dbgsym*' | sort
}
