#!/usr/bin/env bash
# Makes celspan for web pages, which is the npm package celspan-web: one WebAssembly, its glue and
# what it asks for; and, for the site alone, celspan-whole.wasm, which has all but what writes films
# and plays footage: pictures, paintings, tools for drawings, and the writers of SVG, Lottie and
# planes.
#
#   packaging/page/build.sh BUILD FOLDER     BUILD: a folder for what is compiled; FOLDER is deleted
#                                            first
#
# Ends with 77 where Debian's mirrors give no sources of the libraries.
#
# Meson compiles with clang itself, because emcc begins an interpreter for each file; the C library
# and the linking are emcc's.
set -eu -o pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
rm -rf "$2"
mkdir -p "$1/bin" "$2"
build=$(cd "$1" && pwd)
folder=$(cd "$2" && pwd)

# compiler NAME CLANG OPTION...: the command of the cross file. Rows are drawn with -O2, because -O3
# is larger and not faster here, and all else, which meson compiles with -Os, becomes as small as it
# can be. Nothing is loaded at another address. Pairs of numbers are not joined to registers
# (-fno-slp-vectorize), because clang 14 then changes what some of them become: an outline that was
# traced had other corners.
compiler() {
  cat >"$build/bin/$1" <<TEXT
#!/bin/bash
for word; do
  case \$word in
  -O2 | -Os) words+=(-Oz) ;;
  -O3) words+=(-O2) ;;
  -fPIC) ;;
  *) words+=("\$word") ;;
  esac
done
exec $2 ${*:3} "\${words[@]}" -fno-slp-vectorize
TEXT
  chmod +x "$build/bin/$1"
}

options=$(emcc --cflags)
options="${options/-fvisibility=default/-fvisibility=hidden} -msimd128 -mbulk-memory"
options+=" -Wno-unused-command-line-argument"
compiler page-cc clang "$options"
compiler page-c++ clang++ "$options -Xclang -iwithsysroot/include/c++/v1"
libraries=${options#*--sysroot=}
libraries=${libraries%% *}/lib/wasm32-emscripten
export PATH=$build/bin:$PATH
cd "$top"
mkdir -p "$build/libraries"
tests/portable/libraries.sh page "$build/libraries"
[ -f "$build/meson/build.ninja" ] || meson setup "$build/meson" -Dpage=true -Doptimization=s \
  -Ddebug=false -D{desk,pictures,raster,colour,spaces,avif,webp,pdf,web}=disabled -Dtype=enabled \
  -Dtests=false --cross-file tests/portable/page.txt \
  --cross-file "$build/libraries/page/libraries.txt"
ninja "-j${JOBS:-$(nproc)}" -C "$build/meson" page

# Lua computes with the engine's functions (src/kit/lua/bind/libm.c).
wrapped=(sin cos tan asin acos atan2 exp log log2 log10 pow)
meson=$build/meson
archives=("$meson"/src/kit/page/libcelspan_page{,_memory}.a
  "$meson"/src/{kit/lua/module/libcelspan_lua,kit/plugins/type/libcelspan_type,libcelspan}.a
  "$build"/libraries/page/lib/lib{lua5.4,harfbuzz,fribidi,unibreak,expat,z}.a)
mkdir -p "$build/linked"

# link NAME OPTION...: the file of this name; the options are for it alone.
link() {
  local linked=$build/linked/$1 lacks
  wasm-ld -o "$linked" --whole-archive "${archives[@]:0:2}" "${@:2}" --no-whole-archive \
    "${archives[@]:2}" "-L$libraries" -l{c,dlmalloc,compiler_rt,c++-noexcept,c++abi-noexcept} \
    "${wrapped[@]/#/--wrap=}" --import-undefined --no-entry --export-table --strip-debug \
    --export-if-defined={malloc,free,setThrew,stackSave,stackRestore,__wasm_call_ctors} \
    -z stack-size=1048576 --initial-memory=16777216 --max-memory=2147418112 --global-base=1024
  # A function of ours that no file has would become one of JavaScript.
  lacks=$(node -p 'const linked = new WebAssembly.Module(fs.readFileSync(process.argv[1]));
    WebAssembly.Module.imports(linked).map(({ name }) => name)
      .filter((name) => /^(cs|celspan|lua)_/.test(name)).join(" ")' "$linked")
  [ -z "$lacks" ] || { echo "no file that is linked has: $lacks" >&2 && exit 1; }
  wasm-opt -Oz -Oz --enable-simd --enable-bulk-memory --enable-sign-ext --enable-mutable-globals \
    --enable-nontrapping-float-to-int --low-memory-unused --zero-filled-memory \
    --merge-similar-functions --strip-debug --strip-producers --strip-target-features \
    "$linked" -o "$folder/$1"
}
link celspan.wasm
link celspan-whole.wasm "$meson/src/kit/page/libcelspan_whole.a" \
  "$build"/libraries/page/lib/lib{png16,jpeg}.a \
  --wrap=cs_file_{create,commit,again} # src/kit/page/writers.c
cp "$top"/packaging/page/npm/{index.d.ts,README.md} "$meson/src/kit/lua/module/more.json" "$folder"
for name in engine render; do # without the lines that are comments
  perl -0pe 's{^ */\*\*.*?\*/\n}{}gms; s{^ *//.*\n}{}gm' "$top/packaging/page/$name.mjs" \
    >"$folder/$name.mjs"
done
lua5.4 "$top/packaging/page/font.lua" "$top/scripts/type/block.ttf" "$folder/block.ttf"
version=$(sed -n "s/^  version: '\(.*\)',/\1/p" "$top/meson.build")
sed "s/@VERSION@/$version/" "$top/packaging/page/npm/package.json.in" >"$folder/package.json"

# What is linked in; FriBidi's licence (LGPL) wants a way to link another one, which is this script.
# The package does not have the libraries of celspan-whole.wasm alone.
cp "$top/LICENSE" "$folder/LICENSES"
for library in lua5.4 harfbuzz fribidi libunibreak expat zlib libpng1.6 libjpeg-turbo; do
  names=(debian/copyright LICENCE)
  [ "$library" != harfbuzz ] || names=(COPYING) # the other is of its tests and their fonts, too
  licence=$(cd "$build"/libraries/sources/"$library"-*/ && cat "${names[@]}" 2>/dev/null) || true
  [ -n "$licence" ] || { echo "there is no licence of $library" >&2 && exit 1; }
  [[ $library == lib[pj]* ]] && list=LICENSES-whole || list=LICENSES
  printf '\n======== %s\n\n%s\n' "$library" "$licence" >>"$folder/$list"
done
