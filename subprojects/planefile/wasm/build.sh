#!/bin/sh
# The decoder as WebAssembly, in base64: build.sh OUT SOURCE... The functions that draw are made for
# speed, all others to be small. CLANG and WASM_LD: the programs; without them OUT is the word none.
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
    */draw.c | */pixels.c) level='-Os -fno-vectorize -fno-unroll-loops -msimd128' ;;
    */program.c) level='-Os -msimd128' ;;
    *) level='-Oz -mllvm -inline-threshold=-50' ;;
  esac
  # shellcheck disable=SC2086
  "$CLANG" --target=wasm32 -std=c17 $level -ffreestanding -nostdlibinc -ffp-contract=off \
    -ffunction-sections -fdata-sections -fvisibility=hidden -fno-ident \
    -mbulk-memory -msign-ext -mnontrapping-fptoint -mmutable-globals \
    -Wall -Wextra -Werror -I"$here/include" -I"$here/../include" \
    -c "$source" -o "$folder/$(basename "$source").o"
done
"$WASM_LD" --no-entry --gc-sections --strip-all -O2 --lto-O2 -z stack-size=65536 --stack-first \
  -o "$folder/plane.wasm" "$folder"/*.o
base64 -w 0 "$folder/plane.wasm" >"$out"
