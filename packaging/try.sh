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

# seconds COMMAND...: how long it takes, of the clock.
seconds() {
  local TIMEFORMAT=%R
  { time "$@" >/dev/null 2>&1; } 2>&1
}

try_archive() {
  local suite=$1 root=$roots/try
  copy "$suite" try || { say "$suite: the mirror does not have it" && return; }
  mkdir "$root/fetched"
  cp "$dist/install.sh" "$dist/SHA256SUMS" "$dist/$name.tar.gz" packaging/verbs.sh "$root/fetched"
  trial "$suite, archive" inside try sh -c '/fetched/install.sh && sh /fetched/verbs.sh celspan'
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
    npm install --offline --no-audit --no-fund "$1" && npx --offline celspan init by-npx &&
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

# The source archive builds, and the tests of its style and of the command line pass.
try_source() {
  local place=$work/try.source
  unpacked "$place"
  # shellcheck disable=SC2016
  trial "the source archive" sh -c 'cd "$0" && meson setup build -Dunit=false &&
    ninja -C build -j2 && meson test -C build --print-errorlogs style/columns spec/cli &&
    build/celspan --version' "$place"
}

# starts PROGRAM: milliseconds of one start, of 200.
starts() {
  # shellcheck disable=SC2016
  awk "BEGIN { print $(seconds bash -c 'for i in {1..200}; do "$0" --version; done' "$1") * 5 }"
}

compare_starts() {
  local built packed root=$work/starts
  [ -x build/celspan ] || return 0
  rm -rf "$root"
  mkdir -p "$root"
  tar -xzf "$dist/$name.tar.gz" -C "$root" --strip-components=1
  built=$(starts build/celspan) packed=$(starts "$root/bin/celspan")
  awk "BEGIN { printf \"== a start takes %.2f ms packed, %.2f ms built: %.2f times\n\",
    $packed, $built, $packed / $built }"
}

try() {
  local suite suites=("$@")
  [ $# -gt 0 ] || suites=(bullseye bookworm trixie)
  for suite in "${suites[@]}"; do try_archive "$suite"; done
  [ $# -gt 0 ] || {
    try_npm
    try_container
    try_source
    compare_starts
  }
  rm -rf "${roots:?}/try"
  (cd "$dist" && find . -maxdepth 1 -type f -printf '%9s bytes  %f\n' | sort -k3)
  printf '%d passed, %d failed\n' "$tried" "$wrong"
  [ "$wrong" = 0 ]
}
