#!/bin/bash
# Whether other platforms give the same bits: builds celspan for each, asks the questions of
# tests/golden there, and prints a row of the table in docs/trust.md for each.
#
#   tests/portable/run.sh [--sample] [PLATFORM...]
#
#   x86-64       the program in build/, with the widest instructions of this processor
#   x86-64-sse   the same in emulation of a processor without wider ones; only if it is named
#   x86-64-avx2  likewise
#   musl         another C library, linked statically, without modules
#   wasm         WebAssembly in node, without modules, threads and processes
#   aarch64      another processor, in emulation, with Debian's libraries for the modules
#   armhf        likewise
#   i386         likewise, but not in emulation where the kernel runs its programs
#   memory       this processor, in clang's memory sanitizer, which reports every branch and write
#                that depends on memory that was never written; only if it is named
#
# --sample: one question in ten.
set -u -o pipefail
cd "$(dirname "$0")/../.." || exit 1
out=$PWD/out/portable
programs=(celspan examples/example_{surface,memory,embed,host})
every=1 outcome=0

# i386_loader: most x86-64 kernels run programs of i386, by the loader of their own libraries.
i386_loader() {
  local root=$out/i386
  local loader=$root/lib/ld-linux.so.2 folders=$root/usr/lib/i386-linux-gnu
  folders+=:$root/lib/i386-linux-gnu:$root/usr/lib
  "$loader" --version >/dev/null 2>&1 && echo "$loader --library-path $folders"
}

# emulator PLATFORM: the command that runs a program of it.
emulator() {
  case $1 in
  x86-64-sse) echo qemu-x86_64 -cpu Nehalem ;;
  x86-64-avx2) echo qemu-x86_64 -cpu max ;; # it has no wider ones
  aarch64) echo "qemu-aarch64 -L $out/aarch64" ;;
  armhf) echo "qemu-arm -L $out/armhf" ;;
  wasm) echo node --no-experimental-fetch ;; # emcc's programs would fetch their own file
  i386) i386_loader || echo "qemu-i386 -L $out/i386" ;;
  esac
}

# options PLATFORM: of meson.
options() {
  echo -Dpictures=disabled -Dcolour=disabled -Dweb=disabled -Dtests=false -Doptimization=1 \
    -Ddebug=false
  case $1 in
  musl | wasm | memory) echo -Dmodules=false -Draster=disabled -Dtype=disabled ;;
  *) echo -Draster=enabled -Dtype=enabled ;;
  esac
  # Meson takes the version of emcc for one of clang that does not know C17, which it is set to.
  [ "$1" != wasm ] || echo -D{,spanfile:,planefile:}c_std=none
}

# build PLATFORM: quietly, unless it fails.
build() {
  local folder=$out/$1/build log=$out/$1/log targets=("${programs[@]}")
  [[ $1 =~ musl|wasm|memory ]] || targets+=(examples/example_{painting,letters}
    src/kit/plugins/raster/celspan-raster.so src/kit/plugins/type/celspan-type.so)
  [ "$1" != wasm ] || targets=("${targets[@]/%/.js}")
  mkdir -p "$out/$1"
  {
    # shellcheck disable=SC2046
    tests/portable/libraries.sh "$1" "$out" &&
      { [ -f "$folder/build.ninja" ] || meson setup "$folder" $(options "$1") \
        --cross-file "tests/portable/$1.txt" --cross-file "$out/$1/libraries.txt"; } &&
      ninja "-j${JOBS:-$(nproc)}" -C "$folder" "${targets[@]}"
  } >"$log" 2>&1 || {
    tail -40 "$log" >&2
    return 1
  }
}

# ask PLATFORM BUILD: of commands that have the names of the programs, as
# tests/support/golden.lua calls them.
ask() {
  local commands=$out/$1/commands name program
  mkdir -p "$commands/examples"
  for name in celspan examples/example_{surface,memory,embed,host,painting,letters}; do
    for program in "$2/$name"{,.js}; do
      [ -f "$program" ] || continue
      printf '#!/bin/sh\nexec %s "%s" "$@"\n' "$(emulator "$1")" "$program" >"$commands/$name"
      chmod +x "$commands/$name"
    done
  done
  CELSPAN=$commands/celspan CELSPAN_BUILD=$commands lua5.4 tests/portable/digests.lua "$1" "$every"
}

[ "${1:-}" != --sample ] || { every=10 && shift; }
[ $# != 0 ] || set -- x86-64 musl wasm aarch64 armhf i386
echo "| platform | equal | different | not asked |"
echo "|---|---|---|---|"
for platform in "$@"; do
  case $platform in
  x86-64*) ask "$platform" "$PWD/build" ;;
  *) build "$platform" && ask "$platform" "$out/$platform/build" ;;
  esac || outcome=1
done
exit $outcome
