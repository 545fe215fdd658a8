import { open } from "./engine.mjs";

// The frames that the script draws.
class Artist {
  static async open(part) {
    const artist = new Artist(), text = bytes => new TextDecoder().decode(bytes);
    const files = JSON.parse(text(await part("more.json")));
    for (const [name, place] of Object.entries(FILM.files)) files[name] = await part(place);
    artist.engine = await open(await part("celspan.wasm"), { files });
    artist.script = text(files[`/${FILM.script}`]);
    return artist;
  }
  prepare(set) { this.engine.run(this.script, { name: FILM.script, set }); }
  draw(frame, width, height) {
    this.engine.frame(frame);
    return new ImageData(this.engine.pixels(width, height).slice(), width, height);
  }
}
