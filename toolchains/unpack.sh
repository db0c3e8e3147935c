#!/bin/sh
# Unpacks Debian packages of a foreign architecture into a folder, without a word to the host's own dpkg and apt.
# Usage: unpack.sh ARCH DIR PACKAGE...
#   ARCH      arm64, armhf or amd64
#   DIR       made when missing; DIR.apt beside it keeps lists and downloads
#   PACKAGE   with everything that it depends on; =PACKAGE: alone (-dev packages that pull in more than their headers)
# The mirror is the one that the host's apt uses for its own release. Does nothing when DIR already holds just this.
set -eu
arch=$1
dir=$2
shift 2
[ "$#" -gt 0 ]
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
stamp=$dir.stamp
wanted="$arch $suite $*"
if [ -e "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ]; then
    exit 0
fi
rm -rf "$dir" "$stamp"
mkdir -p "$dir"
dir=$(cd "$dir" && pwd)
apt=$dir.apt
mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/parts"
: >"$apt/status"

mirror=$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' |
    awk -v suite="$suite" '$2 == suite { print $1; exit }')
if [ -z "$mirror" ]; then
    echo "unpack.sh: apt has no source for $suite" >&2
    exit 1
fi
# The release itself and nothing beside it: its index is complete for every architecture.
echo "deb [arch=$arch signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" >"$apt/sources.list"

foreign_apt() {
    apt-get -q -y --no-install-recommends -o APT::Architecture="$arch" -o APT::Architectures::="$arch" \
        -o APT::Architectures="$arch" -o Dir::Etc::sourcelist="$apt/sources.list" \
        -o Dir::Etc::sourceparts="$apt/parts" -o Dir::Etc::preferencesparts="$apt/parts" \
        -o Dir::State::lists="$apt/lists" -o Dir::State::status="$apt/status" -o Dir::Cache="$apt/cache" \
        -o Debug::NoLocking=1 -o APT::Sandbox::User=root -o Acquire::Retries=3 "$@"
}

whole=
alone=
for package in "$@"; do
    case $package in
    =*) alone="$alone ${package#=}" ;;
    *) whole="$whole $package" ;;
    esac
done
foreign_apt update
rm -f "$apt"/cache/archives/*.deb
[ -z "$whole" ] || foreign_apt --download-only install $whole
[ -z "$alone" ] || (cd "$apt/cache/archives" && foreign_apt download $alone)

# A merged /usr, as on an installed system.
for sub in bin sbin lib; do
    mkdir -p "$dir/usr/$sub"
    ln -s "usr/$sub" "$dir/$sub"
done
for package in "$apt"/cache/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink -C "$dir"
done
# What update-alternatives would have linked.
for sub in "$dir"/usr/lib/*-linux-gnu*; do
    for library in blas lapack; do
        [ ! -e "$sub/$library/lib$library.so.3" ] || ln -sf "$library/lib$library.so.3" "$sub/lib$library.so.3"
    done
done
# Absolute links become relative: the host's own files are never meant.
find "$dir" -type l -lname '/*' | while read -r link; do
    target=$(readlink "$link")
    [ ! -e "$dir$target" ] || ln -sfn "$(realpath -m --relative-to="$(dirname "$link")" "$dir$target")" "$link"
done
echo "$wanted" >"$stamp"
echo "$dir: $(find "$apt/cache/archives" -name '*.deb' | wc -l) packages, $(du -sm "$dir" | cut -f1) MB"
