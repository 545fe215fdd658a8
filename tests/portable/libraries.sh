#!/bin/bash
# What celspan is linked with on another platform, with the compiler of its cross file: zlib and
# Lua, built from Debian's source packages, and for a processor that Debian has, its packages of
# what the modules need, unpacked. This machine's own packages stay as they are. For pages
# (packaging/page) also what the type module needs is built from source packages.
#
#   tests/portable/libraries.sh NAME FOLDER     FOLDER/NAME gets include, lib and libraries.txt
set -eu
here=$(cd "$(dirname "$0")" && pwd)
name=$1
mkdir -p "$2/sources" "$2/$name"
folder=$(cd "$2" && pwd)
out=$folder/$name
MODULE_PACKAGES=(libexpat1-dev libharfbuzz-dev libfribidi-dev libunibreak-dev libpng-dev
  libjpeg62-turbo-dev libopenexr-dev libtiff-dev libwebp-dev)

# What Debian calls the processor, and the folder of its libraries; nothing: it has no such.
case $name in
aarch64) debian=arm64 triplet=aarch64-linux-gnu ;;
armhf) debian=armhf triplet=arm-linux-gnueabihf ;;
i386) debian=i386 triplet=i386-linux-gnu ;;
*) debian='' triplet='' ;;
esac

# apt_get KIND ARCHITECTURE ARGUMENT...: of this machine's Debian, from where its packages come; it
# writes into the folder alone, and takes nothing for installed. KIND: deb or deb-src.
apt_get() {
  local apt=$folder/apt/$1-$2
  mkdir -p "$apt/lists/partial" "$apt/archives/partial"
  touch "$apt/status"
  # shellcheck disable=SC2016
  [ -s "$apt/sources.list" ] || apt-get indextargets \
    --format "$1"' $(SITE) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | sort -u >"$apt/sources.list"
  apt-get -y --no-install-recommends -o "APT::Architecture=$2" -o "APT::Architectures::=$2" \
    -o "Dir::Etc::SourceList=$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" \
    -o "Dir::Cache::archives=$apt/archives" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= \
    "${@:3}"
}

release=$(. /etc/os-release && echo "$VERSION_CODENAME")

# has_source NAME: whether the folder of a source package is there.
has_source() { [ -n "$(find "$folder/sources" -maxdepth 1 -type d -name "$1*")" ]; }

# lack PACKAGE: 77 says that nothing is wrong with what is built.
lack() {
  echo "Debian's mirrors gave no sources of $1, so celspan is not built for $name" >&2
  exit 77
}

# fetch_source PACKAGE: an update may have gone from the mirror: the release's own version is taken
# then.
fetch_source() {
  local own
  own=$(dpkg --print-architecture)
  has_source "$1" && return
  [ -d "$folder/apt/deb-src-$own/lists/partial" ] || apt_get deb-src "$own" update
  (cd "$folder/sources" && { apt_get deb-src "$own" source "$1" ||
    apt_get deb-src "$own" source "$1/$release"; })
}

fetch_sources() {
  local package
  for package in "$@"; do fetch_source "$package" || lack "$package"; done
}

# Debian's mirrors no longer have the sources of its libunibreak: those of the next release.
fetch_unibreak() {
  fetch_source libunibreak 2>/dev/null || {
    local own list
    own=$(dpkg --print-architecture)
    mkdir -p "$folder/apt/next-$own"
    list=$folder/apt/next-$own/sources.list
    sed s/bookworm/trixie/ "$folder/apt/deb-src-$own/sources.list" >"$list"
    apt_get next "$own" update
    (cd "$folder/sources" && apt_get next "$own" source --tar-only libunibreak &&
      tar xf libunibreak_*.orig.tar.*)
  }
}

unpack_packages() {
  local package
  apt_get deb "$debian" update || echo "not all lists are new: the versions may be older"
  apt_get deb "$debian" install --download-only "${MODULE_PACKAGES[@]}"
  for package in "$folder/apt/deb-$debian"/archives/*.deb; do
    dpkg-deb --extract "$package" "$out"
  done
}

# in_cross_file NAME: the words of a list or a text in the cross file; none, if it has none.
in_cross_file() { sed -n "s/^$1 = //p" "$here/$name.txt" | tr -d "[],'"; }

options=() # more options of the compiler

# build NAME FILE...: an archive of these sources, in the current folder.
build() {
  local archive=$out/lib/lib$1.a file objects=() language
  shift
  for file in "$@"; do
    objects+=("$out/objects/$(basename "$file").o")
    [[ $file == *.cc ]] && language=cpp || language=c
    # shellcheck disable=SC2046
    $(in_cross_file $language) -O2 -ffp-contract=off $(in_cross_file c_args) -fPIC -I. \
      "-I$out/include" ${options[@]+"${options[@]}"} -c "$file" -o "${objects[-1]}"
  done
  $(in_cross_file ar) rcs "$archive" "${objects[@]}"
}

# describe NAME VERSION LIBRARY
describe() {
  printf 'Name: %s\nDescription: %s\nVersion: %s\nCflags: -I%s\nLibs: -L%s -l%s\n' \
    "$1" "$1" "$2" "$out/include" "$out/lib" "$3" >"$out/lib/pkgconfig/$1.pc"
}

build_libraries() {
  mkdir -p "$out/include" "$out/lib/pkgconfig" "$out/objects"
  cd "$folder"/sources/zlib-*/
  build z adler32.c compress.c crc32.c deflate.c infback.c inffast.c inflate.c inftrees.c trees.c \
    uncompr.c zutil.c
  cp zlib.h zconf.h "$out/include"
  describe zlib 1.2.13 z
  cd "$folder"/sources/lua5.4-*/src
  # Of Debian's patch.
  echo '#define DEB_HOST_MULTIARCH "other"' >"$out/include/lua5.4-deb-multiarch.h"
  build lua5.4 l[!u]*.c lu[!a]*.c # all but the interpreter and the compiler
  cp lua.h luaconf.h lualib.h lauxlib.h "$out/include"
  describe lua5.4 5.4.4 lua5.4
}

build_expat() {
  cd "$folder"/sources/expat-*/expat/lib
  : >"$out/include/expat_config.h"
  options=(-DXML_DTD -DXML_NS -DXML_CONTEXT_BYTES=1024 -DXML_POOR_ENTROPY -DBYTEORDER=1234 -w)
  build expat xmlparse.c xmlrole.c xmltok.c
  cp expat.h expat_external.h "$out/include"
  describe expat 2.5.0 expat
}

build_harfbuzz() {
  cd "$folder"/sources/harfbuzz-*/src
  options=(-std=c++17 -fno-exceptions -fno-rtti -fno-threadsafe-statics -w
    -DHB_CONFIG_OVERRIDE_H="\"$here/../../packaging/page/harfbuzz.h\"")
  build harfbuzz harfbuzz.cc
  cp hb.h hb-*.h "$out/include"
  describe harfbuzz 6.0.0 harfbuzz
}

build_fribidi() {
  cd "$folder"/sources/fribidi-*/lib
  printf '#define %s\n' 'FRIBIDI "fribidi"' 'FRIBIDI_NAME "GNU FriBidi"' 'FRIBIDI_VERSION "1.0.8"' \
    'FRIBIDI_INTERFACE_VERSION 4' 'FRIBIDI_INTERFACE_VERSION_STRING "4"' 'FRIBIDI_SIZEOF_INT 4' \
    >"$out/include/fribidi-config.h"
  options=(-DHAVE_STDLIB_H -DHAVE_STRING_H -DHAVE_STRINGIZE -DSTDC_HEADERS -w)
  build fribidi fribidi-bidi.c fribidi-bidi-types.c fribidi-brackets.c fribidi-joining-types.c \
    fribidi-mirroring.c fribidi-run.c fribidi.c
  cp fribidi.h fribidi-*.h "$out/include"
  describe fribidi 1.0.8 fribidi
}

build_unibreak() {
  cd "$folder"/sources/libunibreak-*/src
  options=(-w)
  local file files=()
  # Newer versions have more files.
  for file in linebreak linebreakdata linebreakdef unibreakbase unibreakdef eastasianwidthdef; do
    [ ! -f "$file.c" ] || files+=("$file.c")
  done
  build unibreak "${files[@]}"
  cp ./*.h "$out/include"
  describe libunibreak 1.1 unibreak
}

build_png() {
  cd "$folder"/sources/libpng1.6-*/
  cp scripts/pnglibconf.h.prebuilt "$out/include/pnglibconf.h"
  options=(-w)
  build png16 png.c pngerror.c pngget.c pngmem.c pngread.c pngrio.c pngrtran.c pngrutil.c pngset.c \
    pngtrans.c
  cp png.h pngconf.h "$out/include"
  describe libpng 1.6.39 png16
}

# What reads, without instructions of a processor.
build_jpeg() {
  cd "$folder"/sources/libjpeg-turbo-*/
  printf '#define %s\n' 'JPEG_LIB_VERSION 62' 'LIBJPEG_TURBO_VERSION 2.1.5' 'BITS_IN_JSAMPLE 8' \
    'LIBJPEG_TURBO_VERSION_NUMBER 2001005' 'D_ARITH_CODING_SUPPORTED 1' \
    'MEM_SRCDST_SUPPORTED 1' >"$out/include/jconfig.h"
  printf '#define %s\n' 'BUILD ""' 'INLINE inline' 'THREAD_LOCAL' 'PACKAGE_NAME "libjpeg-turbo"' \
    'VERSION "2.1.5"' 'SIZEOF_SIZE_T 4' 'FALLTHROUGH' >"$out/include/jconfigint.h"
  sed s/@COPYRIGHT_YEAR@/1991-2023/ jversion.h.in >"$out/include/jversion.h"
  options=(-w)
  build jpeg jd{api{min,std},arith,atasrc,coefct,color,dctmgr,huff,icc,input,mainct,marker}.c \
    jd{master,merge,phuff,postct,sample}.c jidct{flt,fst,int,red}.c jmem{mgr,nobs}.c \
    j{aricom,comapi,error,quant1,quant2,simd_none,utils}.c
  cp jpeglib.h jerror.h jmorecfg.h "$out/include"
  describe libjpeg 2.1.5 jpeg
}

# The folder is the root of the unpacked packages, and what is built in it comes first.
write_properties() {
  local own=$out/lib/pkgconfig
  if [ -z "$debian" ]; then
    printf "[properties]\npkg_config_libdir = '%s'\n" "$own"
  else
    printf "[properties]\nsys_root = '%s'\npkg_config_libdir = ['%s', '%s', '%s', '%s']\n" "$out" \
      "$own" "$out"/usr/{"lib/$triplet",lib,share}/pkgconfig
    printf "[built-in options]\nc_link_args = ['-Wl,-rpath-link,%s', '-Wl,-rpath-link,%s']\n" \
      "$out/usr/lib/$triplet" "$out/lib/$triplet"
  fi
}

[ ! -f "$out/libraries.txt" ] || exit 0
fetch_sources zlib lua5.4
build_libraries
if [ "$name" = page ]; then
  fetch_sources expat harfbuzz fribidi libpng1.6 libjpeg-turbo
  fetch_unibreak || lack libunibreak
  build_expat
  build_harfbuzz
  build_fribidi
  build_unibreak
  build_png
  build_jpeg
fi
[ -z "$debian" ] || unpack_packages
write_properties >"$out/libraries.txt"
