// The frames of a plane file. It has no parameters.
class Artist {
  static async open(part) {
    const artist = new Artist();
    artist.plane = await Plane.open(await part("film.plane"));
    return artist;
  }
  prepare() {}
  draw(frame, width, height) {
    this.plane.choose(frame - FILM.first);
    return this.plane.draw(width, height, 0, 0, width, height);
  }
}
