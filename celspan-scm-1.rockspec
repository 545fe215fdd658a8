-- The module from a checkout of the tree: `luarocks --lua-version 5.4 make` in its folder.
rockspec_format = "3.0"
package = "celspan"
version = "scm-1"
source = {
  url = "git+file://.",
}
description = {
  summary = "Compositing engine for cel animation",
  detailed = [[
Films described frame by frame in Lua and composed as spans of colour: paints and gels, cels under a
camera, light from the front and from behind. The animation library is built into the module.
Needs a C17 compiler, meson, ninja and zlib; for pictures a C++17 compiler and OpenImageIO, for
drawings and type expat, HarfBuzz, FriBidi and libunibreak, for colour profiles Little CMS.]],
  license = "MIT",
}
dependencies = {
  "lua >= 5.4, < 5.5",
}
-- CELSPAN_BUILD names a build folder that meson has made already; without it build-rock is made.
build = {
  type = "command",
  build_command = [[
build=${CELSPAN_BUILD:-build-rock}
[ -f "$build/build.ninja" ] || meson setup "$build" --buildtype=release -Dtests=false
ninja -C "$build"]],
  install_command = [[
build=${CELSPAN_BUILD:-build-rock}
install -D -m 755 "$build/celspan.so" "$(LIBDIR)/celspan.so" &&
install -D -m 644 "$build/lua/celspan.d.lua" "$(PREFIX)/annotations/celspan.d.lua" &&
for module in plugins/oiio/celspan-picture.so plugins/type/celspan-type.so plugins/icc/celspan-colour.so \
  plugins/cairo/celspan-pdf.so; do
  if [ -f "$build/src/kit/$module" ]; then
    install -D -m 755 "$build/src/kit/$module" "$(LIBDIR)/celspan/${module##*/}" || exit 1
  fi
done]],
}
