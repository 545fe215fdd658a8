type Content = string | ArrayBuffer | ArrayBufferView;
/** Contents of files, by the paths under which the script names them. */
export type Files = Record<string, Content>;
/** The compiled celspan.wasm, or its bytes. */
export type Module = WebAssembly.Module | ArrayBuffer | ArrayBufferView;
/** Values of parameters: points as "120,80", colours as "#f26419". */
export type Values = Record<string, string | number | boolean>;
/** RGBA of 8 bits, sRGB, straight alpha, row by row: new ImageData(data, width, height). */
export interface Pixels { width: number; height: number; data: Uint8ClampedArray }

export interface RenderOptions {
  module: Module;
  /** The number of the frame; by default the first one. */
  frame?: number;
  /** Pixels, each from 1 to 16384; by default the size of the film. */
  size?: [width: number, height: number];
  set?: Values;
  files?: Files;
  /** "png" by default. */
  format?: "png" | "pixels";
  /** The name of the script in messages, and the folder of its files; "film.lua" by default. */
  name?: string;
  /** The most instructions of the script while it runs and while a frame is built; 3e8 by default. */
  steps?: number;
  /** The most bytes of the WebAssembly, 32 MiB or more; 256 MiB by default. */
  memory?: number;
}

export interface RenderError extends Error {
  /** A celspan_status; undefined: the options are wrong. */
  status?: number;
  /** The paths of files that were looked for in vain. */
  missing?: string[];
}

/** A frame of a film from the text of a script. It is rejected with a RenderError. */
export function render(source: string,
  options: RenderOptions & { format: "pixels" }): Promise<Pixels>;
export function render(source: string, options: RenderOptions): Promise<Uint8Array>;

export interface Film { width: number; height: number; first: number; count: number; fps: number }

/** One film at a time, for pages that show many frames of it. */
export interface Engine {
  file(path: string, content: Content): void;
  clear(): void;
  missing(): string[];
  printed(): string;
  run(script: string, options?:
    { name?: string; set?: Values; steps?: number; memory?: number; room?: number }): Film;
  film(): Film;
  frame(number: number): void;
  /** Leaves only what a line made, such as "film.lua:7"; whether there is any. */
  keep(place: string): boolean;
  /** The lines that made the objects at a point of the film, from the front. */
  at(x: number, y: number): string[];
  version(): string;
  parameters(): { name: string; kind: string; value: string; about: string; least: number;
                  most: number; choices: string[] }[];
  /** Valid until the next call. part: left, top, width, height in the frame. isVideo: over black and
   * dithered, as the program gives frames to encoders. */
  pixels(width: number, height: number, part?: [number, number, number, number],
    isVideo?: boolean): Uint8ClampedArray;
  png(width: number, height: number): Uint8Array;
  digest(width: number, height: number): string;
  memory(): { held: number; most: number; all: number };
  close(): void;
}
export function open(module: Module,
  options?: { files?: Files; now?: () => number }): Promise<Engine>;
