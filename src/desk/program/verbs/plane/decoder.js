// The decoder of plane files, as WebAssembly: a part of celspan-film.js.
const DECODER = "@MODULE@"; // packed by gzip, in base64
const TOP = 24, LOWEST = 8, TILE = 256; // levels of the pyramid, and pixels of a tile

const bytes_of = digits => Uint8Array.from(atob(digits), letter => letter.charCodeAt(0));

let compiled = null; // the module, soon

async function compile() {
  try {
    const unpacked = new Blob([bytes_of(DECODER)]).stream()
      .pipeThrough(new DecompressionStream("gzip"));
    return await WebAssembly.compile(await new Response(unpacked).arrayBuffer());
  } catch (fault) {
    throw new Error(`The picture cannot be shown, because this page or browser does not allow `
      + `WebAssembly: ${fault.message}`);
  }
}

// A plane file in a memory of its own.
class Plane {
  // size: that of its file, of which a nest has more than its outer plane needs.
  static async open(bytes, size = bytes.length) {
    compiled ??= compile();
    const plane = new Plane();
    plane.calls = (await WebAssembly.instantiate(await compiled)).exports;
    const address = plane.calls.reserve(bytes.length || 1); // an empty file is no plane
    if (!address) throw new Error("There is not enough memory for this picture.");
    new Uint8Array(plane.calls.memory.buffer, address, bytes.length).set(bytes);
    plane.calls.extend(size);
    plane.choose(0);
    [plane.width, plane.height] = [plane.calls.width(), plane.calls.height()];
    [plane.frames, plane.rate] = [plane.calls.frames(), plane.calls.rate()];
    return plane;
  }

  // Reads a frame, which is drawn from then on.
  choose(frame) {
    if (frame === this.frame) return;
    this.frame = null;
    const reason = this.calls.open(frame);
    if (reason) throw new Error(`This picture is damaged: ${this.text_at(reason)}.`);
    this.frame = frame;
    this.is_opaque = Boolean(this.calls.is_opaque());
  }

  // The text at an address, up to its zero.
  text_at(address) {
    const bytes = new Uint8Array(this.calls.memory.buffer, address);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  // The crop at (x, y) of the frame at a size. The pixels are valid until the next call.
  draw(across, down, x, y, columns, rows) {
    const address = this.calls.draw(across, down, x, y, columns, rows);
    if (!address) throw new Error("There is not enough memory to draw this picture.");
    const { buffer } = this.calls.memory;
    return new ImageData(new Uint8ClampedArray(buffer, address, 4 * columns * rows), columns, rows);
  }

  // As much of the frame as a canvas shows, of which it covers left..right and upper..lower: the
  // pixels and their place there; null: nothing.
  #shown({ left, upper, right, lower }, { width, height }) {
    const x = Math.max(0, left), y = Math.max(0, upper);
    const columns = Math.min(right, width) - x, rows = Math.min(lower, height) - y;
    if (columns <= 0 || rows <= 0) return null;
    const part = [right - left, lower - upper, x - left, y - upper, columns, rows];
    return { pixels: this.draw(...part), x, y };
  }

  // Draws that, in place of the pixels there.
  paint(pencil, box) {
    const shown = this.#shown(box, pencil.canvas);
    if (shown) pencil.putImageData(shown.pixels, shown.x, shown.y);
  }

  // That as { picture, x, y }, without the clear rows and columns around it; null: all is clear.
  cut(box, canvas) {
    const shown = this.#shown(box, canvas);
    if (!shown) return null;
    const [left, upper, right, lower] =
      new Uint32Array(this.calls.memory.buffer, this.calls.seen(), 4);
    if (right === 0) return null;
    const picture = document.createElement("canvas");
    [picture.width, picture.height] = [right - left, lower - upper];
    picture.getContext("2d").putImageData(shown.pixels, -left, -upper);
    return { picture, x: shown.x + left, y: shown.y + upper };
  }

  tile(pyramid, level, column, row) {
    const factor = 2 ** (TOP - level), x = column * TILE, y = row * TILE;
    const across = Math.ceil(pyramid.width / factor), down = Math.ceil(pyramid.height / factor);
    const tile = document.createElement("canvas");
    tile.width = Math.min(TILE, across - x);
    tile.height = Math.min(TILE, down - y);
    const pixels = this.draw(across, down, x, y, tile.width, tile.height);
    tile.getContext("2d").putImageData(pixels, 0, 0);
    return tile;
  }
}
