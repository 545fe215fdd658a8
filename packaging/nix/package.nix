# celspan for Nix: `nix-build packaging/nix/package.nix` in a checkout. Not tested here.
{ pkgs ? import <nixpkgs> { } }:

pkgs.stdenv.mkDerivation {
  pname = "celspan";
  version = "0.1.0";
  src = ../..;
  nativeBuildInputs = with pkgs; [ binaryen clang lld meson ninja pkg-config ];
  buildInputs = with pkgs; [
    cairo
    expat
    fribidi
    harfbuzz
    lcms2
    libavif
    libmicrohttpd
    libunibreak
    libwebp
    lua5_4
    openimageio
    zlib
  ];
  mesonBuildType = "release";
  mesonFlags = [ "-Dtests=false" ];
  meta = {
    description = "2D animation and motion graphics from Lua scripts";
    license = pkgs.lib.licenses.mit;
    mainProgram = "celspan";
    platforms = pkgs.lib.platforms.linux;
  };
}
