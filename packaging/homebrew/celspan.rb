# celspan for Homebrew on Linux, from the source archive that `./run dist` makes. Not tested here. Give
# `url` and `sha256` of the archive before `brew install --build-from-source ./celspan.rb`.
class Celspan < Formula
  desc "2D animation and motion graphics from Lua scripts"
  url "file:///path/to/celspan-0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"

  depends_on "meson" => :build
  depends_on "ninja" => :build
  depends_on "pkg-config" => :build
  depends_on "cairo"
  depends_on "expat"
  depends_on "fribidi"
  depends_on "harfbuzz"
  depends_on "libavif"
  depends_on "libmicrohttpd"
  depends_on "libunibreak"
  depends_on :linux
  depends_on "little-cms2"
  depends_on "lua"
  depends_on "openimageio"
  depends_on "webp"
  depends_on "zlib"

  def install
    system "meson", "setup", "build", "--buildtype=release", "-Dtests=false", *std_meson_args
    system "meson", "compile", "-C", "build"
    system "meson", "install", "-C", "build"
  end

  test do
    system bin/"celspan", "init", "first"
    system bin/"celspan", "render", "first/film.lua", "--frames", "1", "-o", "first.png"
    assert_predicate testpath/"first.png", :exist?
  end
end
