# shellcheck shell=bash disable=SC2154
# Tries the files of out/dist, in roots of Debian with nothing else in them. dist.sh sources this.
#
#   try [SUITE...]      bullseye, bookworm and trixie, as far as the mirror has them
#
# packaging/verbs.sh runs there, once for each way to install.

tried=0 wrong=0

# trial NAME COMMAND...
trial() {
  local what=$1 log=$work/trial.log
  shift
  if "$@" >"$log" 2>&1; then
    tried=$((tried + 1))
    grep '^   ' "$log" || true
    say "$what: good"
  else
    wrong=$((wrong + 1))
    tail -20 "$log"
    say "$what: failed"
  fi
}

try_archive() {
  local suite=$1 root=$roots/try
  copy "$suite" try || { say "$suite: the mirror does not have it" && return; }
  mkdir "$root/fetched"
  cp "$dist/install.sh" "$dist/SHA256SUMS" "$dist/$name.tar.gz" packaging/verbs.sh "$root/fetched"
  local prefix="/opt/Öl und Käse"
  [ "$suite" != bullseye ] || prefix=/usr/local
  # shellcheck disable=SC2016
  trial "$suite, archive in $prefix" inside try sh -c '/fetched/install.sh --prefix "$0" &&
    sh /fetched/verbs.sh "$0/bin/celspan"' "$prefix"
}

# The packages' own tests install them; then the verbs.
try_deb() {
  copy bookworm try || return
  unpacked "$roots/try/fetched/celspan"
  cp -r debian "$roots/try/fetched/celspan"
  cp "$dist"/*.deb packaging/verbs.sh "$roots/try/fetched"
  # shellcheck disable=SC2016
  trial "bookworm, Debian packages" inside try sh -c 'set -e
    cd /fetched
    echo "deb $0 bookworm main" >/etc/apt/sources.list
    apt-get update -q
    apt-get install -qy --no-install-recommends autopkgtest
    autopkgtest --no-built-binaries ./*.deb celspan/ -- null
    apt-get install -qy --no-install-recommends ./celspan_*.deb ./celspan-modules_*.deb
    sh verbs.sh celspan' "$(mirror)"
}

# On this machine, if it has npm, without a network.
try_npm() {
  command -v npm >/dev/null || { say "npm is missing: its package is not tried" && return; }
  local place=$work/try.npm
  rm -rf "$place"
  mkdir -p "$place"
  cp packaging/verbs.sh "$place"
  # shellcheck disable=SC2016
  trial "npm, offline" unshare --net sh -c 'cd "$0" && echo "{}" >package.json &&
    npm install --offline --no-audit --no-fund "$1" && test -s node_modules/celspan/LICENSE &&
    npx --offline celspan init by-npx &&
    npx --offline celspan render by-npx/film.lua --frames 1 -o one.png --progress none &&
    sh verbs.sh "$0/node_modules/.bin/celspan"' "$place" "$dist/celspan-$release.tgz"
}

try_container() {
  local root=$roots/try
  rm -rf "$root"
  mkdir -p "$root"
  tar -xzf "$dist/celspan-$version-root-x86_64.tar.gz" -C "$root"
  cp packaging/verbs.sh "$root/root"
  trial "the root of a container" inside try sh /root/verbs.sh celspan
}

# The source archive builds, and its fast tests pass: of the style, pixels, examples and commands.
try_source() {
  local place=$work/try.source
  unpacked "$place"
  # shellcheck disable=SC2016
  trial "the source archive" sh -c 'cd "$0" && meson setup build -Dunit=false &&
    ninja -C build && build/celspan --version &&
    meson test -C build --print-errorlogs --suite style --suite golden --suite examples &&
    meson test -C build --print-errorlogs --no-rebuild spec/cli spec/help spec/install' "$place"
}

# starts PROGRAM FILM: milliseconds of processor time from nothing to a first colour, the least of
# five rounds.
starts() {
  local TIMEFORMAT='%U %S'
  for _ in {1..5}; do
    # shellcheck disable=SC2016
    { time bash -c 'for i in {1..100}; do "$0" probe "$1" 9 9; done >/dev/null' "$@"; } 2>&1
  done | awk '{ t = 10 * ($1 + $2) } NR == 1 || t < least { least = t } END { print least }'
}

# The packed program starts in at most 1.2 times the time of the one in build/.
try_starts() {
  [ -x build/celspan ] || { say "build/celspan is missing: starts are not compared" && return; }
  local root=$work/starts
  rm -rf "$root"
  mkdir -p "$root"
  tar -xzf "$dist/$name.tar.gz" -C "$root" --strip-components=1
  cat >"$root/film.lua" <<'TEXT'
local celspan = require "celspan"
local disc = celspan.circle { centre = { 9, 9 }, radius = 5 }
return celspan.film { size = { 18, 18 }, frame = function()
  return celspan.rostrum { celspan.cel { disc }, back = "#fff" }
end }
TEXT
  trial "starts, beside build/celspan" awk \
    -v packed="$(starts "$root/bin/celspan" "$root/film.lua")" \
    -v built="$(starts build/celspan "$root/film.lua")" 'BEGIN {
      printf "   a start takes %.2f ms packed, %.2f ms built: %.2f times\n",
        packed, built, packed / built
      exit packed > 1.2 * built
    }'
}

print_sizes() {
  (cd "$dist" && find . -maxdepth 1 -type f -printf '%9s bytes  %f\n' | sort -k3)
  gzip -dc "$dist/$name.tar.gz" | tar --delete --wildcards '*/celspan-raster.so' | as_xz |
    wc -c | xargs printf '%9d bytes  the .tar.xz for Linux without its module for pictures\n'
}

try() {
  local suite suites=("$@")
  [ $# -gt 0 ] || suites=(bullseye bookworm trixie)
  for suite in "${suites[@]}"; do try_archive "$suite"; done
  [ $# -gt 0 ] || {
    try_deb
    try_npm
    try_container
    try_source
    try_starts
  }
  rm -rf "${roots:?}/try"
  print_sizes
  printf '%d passed, %d failed\n' "$tried" "$wrong"
  [ "$wrong" = 0 ]
}
