/** What is shown: the middle and the width in units of the film, and how much larger that is than when
 * everything is shown. */
export interface CelspanFilmView { x: number; y: number; width: number; factor: number }

export interface CelspanFilmEventMap {
  loadeddata: Event;
  play: Event;
  pause: Event;
  timeupdate: Event;
  ended: Event;
  viewchange: Event;
  error: ErrorEvent;
}

/** The element <celspan-film>. */
export interface CelspanFilmElement extends HTMLElement {
  /** The plane file; "#id" is an element of the page with the file in base64. */
  src: string;
  /** In pixels of the page; 0 is the width of the film. */
  width: number;
  poster: string;
  controls: boolean;
  autoplay: boolean;
  loop: boolean;
  muted: boolean;
  /** In seconds. When it is set, the frame of that time is shown. */
  currentTime: number;
  /** In seconds; 0 of a still, NaN until the file is there. */
  readonly duration: number;
  readonly paused: boolean;
  /** null until the file is there. */
  readonly view: CelspanFilmView | null;
  play(): void;
  pause(): void;
  /** Moves to a place, in units of the film, enlarged by a factor; 1 shows everything. */
  zoom(x: number, y: number, factor: number, behavior?: "smooth" | "instant"): void;

  addEventListener<K extends keyof CelspanFilmEventMap>(type: K,
    listener: (this: CelspanFilmElement, event: CelspanFilmEventMap[K]) => unknown,
    options?: boolean | AddEventListenerOptions): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions): void;
}

declare global {
  interface HTMLElementTagNameMap { "celspan-film": CelspanFilmElement }
}
