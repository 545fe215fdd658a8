#!/bin/sh
# The decoder as WebAssembly, packed by gzip and in base64: build.sh OUT SOURCE... It is made to be
# small. CLANG and WASM_LD: the programs; without them OUT is the word none. WASM_OPT: wasm-opt,
# which makes it smaller still: it may take sums of addresses as places of loads, because nothing is
# in the first 1024 bytes, the far end of the stack.
set -eu
out=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
printf none >"$out"
[ -n "${CLANG:-}" ] && [ -n "${WASM_LD:-}" ] || exit 0
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for source in "$@" "$here/module.c" "$here/libc.c"; do
  case $source in
    */coder.c) level=-O2 ;; # where a third of the time goes that it takes to read a frame
    */chords.c | */draw.c | */module.c | */pixels.c | */sums.c) level=-Os ;; # where the time goes
    *) level=-Oz ;;
  esac
  "$CLANG" --target=wasm32 -std=c17 "$level" -flto -msimd128 -ffreestanding -nostdlibinc \
    -ffp-contract=off -ffunction-sections -fdata-sections -fvisibility=hidden -fno-ident \
    -mbulk-memory -msign-ext -mnontrapping-fptoint -mmutable-globals \
    -Wall -Wextra -Werror -I"$here/include" -I"$here/../include" \
    -c "$source" -o "$folder/$(basename "$source").o"
done
"$WASM_LD" --no-entry --gc-sections --strip-all -O2 --lto-O2 -mllvm -inline-threshold=0 \
  -z stack-size=65536 --stack-first \
  -o "$folder/plane.wasm" "$folder"/*.o
[ -z "${WASM_OPT:-}" ] ||
  "$WASM_OPT" -Oz --low-memory-unused --enable-simd --enable-bulk-memory --enable-sign-ext \
    --enable-nontrapping-float-to-int --enable-mutable-globals \
    "$folder/plane.wasm" -o "$folder/plane.wasm"
gzip -9n <"$folder/plane.wasm" | base64 -w 0 >"$out"
