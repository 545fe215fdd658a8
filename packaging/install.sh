#!/bin/sh
# Installs celspan from an archive beside this script:
#
#   install.sh [--prefix DIR] [ARCHIVE]
#
#   DIR/lib/celspan-VERSION/                  all of the archive
#   DIR/bin/celspan, DIR/bin/celspan-VERSION  links to its program
#   DIR/share/...                             links to the manual page and the completions
#
# DIR is ~/.local without --prefix, and /usr/local for root. Without ARCHIVE it is the only one
# beside the script. The archive is compared with SHA256SUMS, unpacked beside its place, tried, and
# renamed: an installation that is stopped leaves no version that is half there.
set -u

say() { printf 'install.sh: %s\n' "$*"; }
die() {
  printf 'install.sh: %s\n' "$*" >&2
  exit 1
}

here=$(cd "$(dirname "$0")" && pwd) || die "the folder of this script cannot be read"
prefix=
archive=
while [ $# -gt 0 ]; do
  case $1 in
  --prefix)
    [ -n "${2:-}" ] || die "--prefix: name a folder"
    prefix=$2
    shift
    ;;
  --prefix=?*) prefix=${1#--prefix=} ;;
  -h | --help)
    sed -n '2,/^set/s/^# \{0,1\}//p' "$0"
    exit 0
    ;;
  -*) die "unknown option '$1' (--prefix DIR)" ;;
  *)
    [ -z "$archive" ] || die "one archive at a time: '$archive' and '$1' were given"
    archive=$1
    ;;
  esac
  shift
done

[ "$(uname -s) $(uname -m)" = "Linux x86_64" ] ||
  die "the archive is for Linux on x86-64, and this is $(uname -s) on $(uname -m)"

if [ -z "$archive" ]; then
  for found in "$here"/celspan-*-linux-x86_64.tar.[gx]z; do
    # The same version may lie there in both forms; the first one can be unpacked everywhere.
    [ ! -f "${found%xz}gz" ] || continue
    [ -z "$archive" ] || die "there are several archives beside this script: name one of them"
    archive=$found
  done
fi
[ -f "$archive" ] || die "there is no archive $archive"
if [ -z "$prefix" ]; then
  prefix=/usr/local
  [ "$(id -u)" = 0 ] || prefix=${HOME:?install.sh: HOME is not set: give --prefix DIR}/.local
fi

# ---------------------------------------------------------------- the sum

name=$(basename "$archive")
version=${name%-linux-x86_64.tar.[gx]z}
case $version in
"$name" | *[!a-zA-Z0-9.+~-]*) die "$name is not the name of an archive of celspan" ;;
esac
packer=gzip letter=z
[ "${name%.xz}" = "$name" ] || packer=xz letter=J
for tool in "$packer" sha256sum tar; do
  command -v "$tool" >/dev/null || die "the program $tool is missing"
done
sums=$(dirname "$archive")/SHA256SUMS
[ -f "$sums" ] || die "SHA256SUMS is missing beside $archive"
wanted=$(while read -r sum file; do
  [ "${file#\*}" != "$name" ] || echo "$sum"
done <"$sums")
[ -n "$wanted" ] || die "$sums has no sum of $name"
found=$(sha256sum <"$archive") || die "$archive cannot be read"
[ "$wanted" = "${found%% *}" ] || die "$archive is damaged: its sum is not the one in SHA256SUMS"

# ---------------------------------------------------------------- unpacking

mkdir -p "$prefix/lib" "$prefix/bin" || die "$prefix cannot be written: give another --prefix DIR"
prefix=$(cd "$prefix" && pwd) || die "$prefix cannot be entered"
place=$prefix/lib/$version
unpacked=$prefix/lib/.$version.$$
old=$prefix/lib/.$version.$$.old
# Removes what this run has not finished, and puts back what it has moved away.
clean() {
  [ ! -d "$old" ] || [ -e "$place" ] || mv "$old" "$place"
  rm -rf "$unpacked" "$old"
}
trap clean EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP
# What runs left that were killed: their numbers belong to no process.
for left in "$prefix/lib/.$version".*; do
  number=${left#"$prefix/lib/.$version."}
  [ ! -e "$left" ] || kill -0 "${number%.old}" 2>/dev/null || rm -rf "$left"
done

mkdir "$unpacked" || die "$prefix/lib cannot be written: give another --prefix DIR"
tar "-x${letter}f" "$archive" -C "$unpacked" --strip-components=1 --no-same-owner ||
  die "the archive could not be unpacked in $prefix/lib: is the disk full?"
said=$("$unpacked/bin/celspan" --version 2>&1) ||
  die "celspan does not run here: $said"

# ---------------------------------------------------------------- its place

if [ -e "$place" ]; then
  mv "$place" "$old" || die "$place cannot be replaced"
fi
mv "$unpacked" "$place" || die "$place cannot be written"
rm -rf "$old"

# put TARGET LINK: a link whose name always leads to something.
put() {
  { mkdir -p "$(dirname "$2")" && ln -s "$1" "$2.$$" && mv -f "$2.$$" "$2"; } ||
    die "$2 cannot be written"
}
put "../lib/$version/bin/celspan" "$prefix/bin/$version"
for file in share/man/man1/celspan.1 share/bash-completion/completions/celspan.bash \
  share/zsh/site-functions/_celspan share/fish/vendor_completions.d/celspan.fish; do
  up=$(printf '%s' "${file%/*}" | sed 's|[^/]*|..|g')
  put "$up/lib/$version/$file" "$prefix/$file"
done
put "../lib/$version/bin/celspan" "$prefix/bin/celspan"

say "$said is in $place"
case :$PATH: in
*":$prefix/bin:"*) say "the first film: celspan init first" ;;
*) say "add $prefix/bin to PATH; the first film: $prefix/bin/celspan init first" ;;
esac
