#!/bin/bash
# Builds the archive for Linux, in a root of Debian 11, so that it runs on glibc 2.31 and later:
#
#   packaging/linux.sh MIRROR NAME      in the root's /build, which has the source in source/
#
#   /build/NAME/           the tree of the archive
#   /build/lua/NAME/       what it lacks of a whole installation: the module for other programs' Lua
#
# What the modules need is linked statically, as the program's Lua always is. What Debian 11 has in
# too old a version, or not as a static library, is built from the source packages of Debian 12:
# expat, Little CMS, HarfBuzz without the libraries that it does not need here, the part of OpenEXR
# that is C, and libmicrohttpd without TLS. Meson and the kernel's headers are Debian 12's, too.
# libunibreak lies beside its module.
set -eu
mirror=$1 name=$2
cd /build
# What nobody calls is left out by the linker; the tables that only C++ exceptions and debuggers use
# are not made.
small=(-ffunction-sections -fdata-sections -fno-asynchronous-unwind-tables)
flags=(-Os -fPIC "${small[@]}")
MAKEFLAGS=-j$(nproc)
export MAKEFLAGS
libraries=/usr/lib/x86_64-linux-gnu
prefix=/build/libraries
mkdir -p "$prefix/lib/pkgconfig" "$prefix/include"

# ---------------------------------------------------------------- packages

cat >/etc/apt/sources.list <<TEXT
deb $mirror bullseye main
deb $mirror bookworm main
deb-src $mirror bookworm main
TEXT
cat >/etc/apt/preferences <<TEXT
Package: *
Pin: release n=bookworm
Pin-Priority: 100
TEXT
apt-get update -q -o Acquire::Languages=none
apt-get install -qy --no-install-recommends binaryen clang dpkg-dev file g++ gcc libfribidi-dev \
  libjpeg62-turbo-dev liblua5.4-dev libpng-dev libtiff-dev libunibreak-dev libwebp-dev libzstd-dev \
  linux-libc-dev/bookworm lld make meson/bookworm ninja-build patchelf pkg-config python3 \
  zlib1g-dev fonts-comic-neue fonts-courier-prime fonts-quicksand

# ---------------------------------------------------------------- libraries

# described NAME VERSION FLAGS: what pkg-config says of a library.
described() {
  cat >"$prefix/lib/pkgconfig/$1.pc" <<TEXT
Name: $1
Description: $1
Version: $2
Cflags: -I$prefix/include
Libs: -L$prefix/lib $3
TEXT
}

# fetched PACKAGE: the source package of Debian 12 is unpacked in the folder PACKAGE.
fetched() {
  apt-get source -q "$1/bookworm"
  rm -f ./*.dsc ./*.tar.*
  mv "$1"-[0-9]* "$1"
}

# version PACKAGE: of the source, without Debian's own numbers.
version() { dpkg-parsechangelog -l "$1/debian/changelog" -S Version | sed 's/[-+].*//'; }

make_expat() {
  fetched expat
  cat >expat/expat_config.h <<TEXT
#define BYTEORDER 1234
#define HAVE_GETRANDOM 1
#define HAVE_MEMMOVE 1
#define XML_CONTEXT_BYTES 1024
#define XML_DTD 1
#define XML_GE 1
#define XML_NS 1
TEXT
  local lib
  lib=$(dirname "$(find expat -name xmlparse.c | head -1)")
  (cd "$lib" && gcc -std=gnu99 "${flags[@]}" -I/build/expat -DHAVE_EXPAT_CONFIG_H -c \
    xmlparse.c xmlrole.c xmltok.c && ar rcs "$prefix/lib/libexpat.a" xmlparse.o xmlrole.o xmltok.o)
  cp "$lib/expat.h" "$lib/expat_external.h" "$prefix/include"
  described expat "$(version expat)" -lexpat
}

make_harfbuzz() {
  fetched harfbuzz
  g++ -std=c++11 "${flags[@]}" -fno-exceptions -fno-rtti -fno-threadsafe-statics \
    -fvisibility-inlines-hidden -DHAVE_PTHREAD -c harfbuzz/src/harfbuzz.cc -o harfbuzz.o
  ar rcs "$prefix/lib/libharfbuzz.a" harfbuzz.o
  mkdir -p "$prefix/include/harfbuzz"
  cp harfbuzz/src/hb*.h "$prefix/include/harfbuzz"
  described harfbuzz "$(version harfbuzz)" "-lharfbuzz -pthread -lm"
  sed -i 's|/include$|/include/harfbuzz|' "$prefix/lib/pkgconfig/harfbuzz.pc"
}

make_lcms2() {
  fetched lcms2
  (cd lcms2/src && gcc "${flags[@]}" -DHAVE_GMTIME_R=1 -I../include -c ./*.c &&
    ar rcs "$prefix/lib/liblcms2.a" ./*.o)
  cp lcms2/include/*.h "$prefix/include"
  described lcms2 "$(version lcms2)" "-llcms2 -pthread -lm"
}

# What CMake would write into its headers is what the part in C asks them for.
make_openexr() {
  fetched imath
  fetched openexr
  local lib=/build/openexr/src/lib/OpenEXRCore imath=/build/imath/src/Imath
  cp "$lib"/openexr*.h "$imath"/{half,ImathExport,ImathNamespace,ImathPlatform}.h "$prefix/include"
  echo "#define ILMTHREAD_THREADING_ENABLED 1" >"$prefix/include/IlmThreadConfig.h"
  cat >"$prefix/include/OpenEXRConfig.h" <<TEXT
#define OPENEXR_EXPORT
#define OPENEXR_VERSION_MAJOR 3
#define OPENEXR_VERSION_MINOR 1
#define OPENEXR_VERSION_PATCH 5
TEXT
  cat >"$prefix/include/ImathConfig.h" <<TEXT
#define IMATH_LIKELY(x) __builtin_expect(x, 1)
#define IMATH_UNLIKELY(x) __builtin_expect(x, 0)
TEXT
  (mkdir openexr/made && cd openexr/made && gcc "${flags[@]}" -DIMATH_HALF_NO_LOOKUP_TABLE \
    "-I$prefix/include" -c "$lib"/*.c && ar rcs "$prefix/lib/libOpenEXRCore.a" ./*.o)
  described OpenEXR "$(version openexr)" "-lOpenEXRCore -lz -pthread -lm"
}

make_microhttpd() {
  fetched libmicrohttpd
  (cd libmicrohttpd && CFLAGS="${flags[*]}" ./configure -q --prefix="$prefix" --disable-shared \
    --with-pic --disable-https --disable-doc --disable-examples --disable-curl --disable-bauth \
    --disable-dauth && make -s -C src/microhttpd install && make -s -C src/include install &&
    cp libmicrohttpd.pc "$prefix/lib/pkgconfig")
}

# Debian's static libraries are for programs: in a module they cannot have the address of stderr.
# They get a copy of it.
copy_stderr() {
  gcc "${flags[@]}" -fvisibility=hidden -x c -c -o stderr.o - <<TEXT
#include <stdio.h>
FILE *own_stderr;
__attribute__((constructor)) static void copy(void) { own_stderr = stderr; }
TEXT
  local library
  for library in "$@"; do
    objcopy --redefine-sym stderr=own_stderr "$libraries/lib$library.a"
    ar rs "$libraries/lib$library.a" stderr.o
  done
}

make_expat
make_harfbuzz
make_lcms2
make_openexr
make_microhttpd
described libtiff-4 4 "-ltiff -lwebp -lzstd -llzma -ljbig -ljpeg -ldeflate -lz -pthread -lm"
copy_stderr png16 jpeg tiff
# The linker takes the static library where there is no other. What the modules contain of them is
# for the modules alone.
static=(fribidi z png png16 jpeg tiff webp zstd lzma jbig deflate)
for library in "${static[@]}"; do rm "$libraries/lib$library.so"; done
hidden=$(printf 'lib%s.a:' "${static[@]}" expat harfbuzz lcms2 microhttpd OpenEXRCore)

# ---------------------------------------------------------------- celspan

# clang, because GCC 10 has no __builtin_shufflevector. The shortest code, but -O3 where rows spend
# their time (src/meson.build): films take as long as with -O2 elsewhere.
export CC=clang CXX=clang++ PKG_CONFIG_PATH=$prefix/lib/pkgconfig CFLAGS=${small[*]}
export LDFLAGS="-Wl,-Bsymbolic -Wl,--gc-sections -Wl,--exclude-libs,${hidden%:}"
meson setup build source --prefix="/build/$name" --libdir=lib --strip \
  -Doptimization=s -Ddebug=false \
  -Dtests=false -Dpictures=disabled -Draster=enabled -Dtype=enabled -Dcolour=enabled \
  -Dspaces=disabled -Davif=disabled -Dwebp=enabled -Dpdf=disabled -Dweb=enabled
ninja -C build -j "$(nproc)"
meson install -C build --quiet --no-rebuild
tree=/build/$name
rm -rf "$tree/lib/pkgconfig" "$tree"/lib/libcelspan* "$tree/include"
mkdir -p "lua/$name/lib"
mv "$tree/lib/lua" "lua/$name/lib"
cp /usr/lib/libunibreak.so.1 "$tree/lib/celspan"
# shellcheck disable=SC2016
patchelf --set-rpath '$ORIGIN' "$tree/lib/celspan/celspan-type.so"
mkdir -p "$tree/share/celspan/examples"/{fonts,type} "$tree/share/doc/celspan/docs"
cp source/packaging/examples/*.lua "$tree/share/celspan/examples"
# The examples in the pages use this font.
cp source/scripts/type/block.ttf "$tree/share/celspan/examples/type"
# The scenery of the recipes, and the scans of a page.
cp -r source/scripts/stage source/scripts/pencil "$tree/share/celspan/examples"
cp source/README.md source/CHANGELOG.md source/LICENSE source/llms.txt "$tree/share/doc/celspan"
cp source/docs/*.md "$tree/share/doc/celspan/docs"
# The pictures are not in the archive, so its pages do not show any.
sed -i -e '/^| \[!\[/d' -e 's/!\[[^]]*\]([^)]*) *//g' "$tree/share/doc/celspan"/{,docs/}*.md

# ---------------------------------------------------------------- fonts, and whose work it all is

# font PACKAGE FILE...: fonts with their licence, which is the OFL.
font() {
  local package=$1 file
  shift
  grep -qi "SIL Open Font\|OFL" "/usr/share/doc/$package/copyright"
  cp "/usr/share/doc/$package/copyright" "$tree/share/celspan/examples/fonts/$package.txt"
  for file in "$@"; do
    cp "$(dpkg -L "$package" | grep "/$file\$" | head -1)" "$tree/share/celspan/examples/fonts"
  done
}
font fonts-quicksand Quicksand-Bold.ttf
font fonts-comic-neue ComicNeue-Bold.otf
font fonts-courier-prime "Courier Prime.otf"

mkdir -p "$tree/share/doc/celspan/libraries"
for package in expat harfbuzz imath lcms2 libmicrohttpd openexr; do
  cp "$package/debian/copyright" "$tree/share/doc/celspan/libraries/$package.txt"
done
for package in libdeflate-dev libfribidi-dev libjbig-dev libjpeg62-turbo-dev liblua5.4-dev \
  liblzma-dev libpng-dev libtiff-dev libunibreak-dev libwebp-dev libzstd-dev zlib1g-dev; do
  cp "/usr/share/doc/$package/copyright" "$tree/share/doc/celspan/libraries/${package%-dev}.txt"
done
cat >"$tree/share/doc/celspan/libraries/README" <<TEXT
The program and its modules contain these libraries, as Debian has them: Lua, zlib, expat,
HarfBuzz, FriBidi, libunibreak, Little CMS, libmicrohttpd, libpng, libjpeg-turbo, libwebp,
OpenEXR's reader, and libtiff with what it decompresses by. Their licences are beside this file.
Two are under the LGPL, FriBidi in lib/celspan/celspan-type.so and libmicrohttpd in
lib/celspan/celspan-web.so: celspan's source builds these files again with other versions of them
(packaging/linux.sh).
TEXT

# ---------------------------------------------------------------- what it may need

# The newest version of glibc that a file asks for.
newest() { objdump -T "$1" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1; }
for file in "$tree/bin/celspan" "$tree"/lib/celspan/*.so "lua/$name/lib/lua/5.4/celspan.so"; do
  others=$(objdump -p "$file" | awk '$1 == "NEEDED" { print $2 }' |
    grep -v -E '^(libc|libm|libdl|libpthread|ld-linux-x86-64|librt|libunibreak)\.so\.' || true)
  if [ -n "$others" ]; then
    echo "linux.sh: $file needs $others, which a system may lack" >&2
    exit 1
  fi
  printf '%s GLIBC_2.31\n' "$(newest "$file")" | tr ' ' '\n' | sort -VC || {
    echo "linux.sh: $file needs $(newest "$file"), and is to run with 2.31" >&2
    exit 1
  }
done
