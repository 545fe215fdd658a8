// What the worker of live/ does for the playground alone. Each call gets a question, and { engine,
// build, progress }: build(question) runs its script, and builds its frame.
import { planes, png } from "./export.js";
import { KINDS, movie } from "./movie.js";

export const calls = {
  about(question, { engine, build }) {
    build(question);
    return { parameters: engine.parameters(), version: engine.version(),
      printed: engine.printed() };
  },
  digest(question, { engine, build }) {
    build(question);
    return engine.digest(question.width, question.height);
  },
  /** The sounds of the film, with the bytes of their files. */
  sounds(question, { engine, build }) {
    build(question);
    return engine.sounds().map(sound => {
      const isData = sound.path.startsWith("data:");
      const bytes = isData ? undefined : engine.content(sound.path);
      if (!bytes && !isData) {
        throw new Error(`There is no ${sound.path}: drop the file on this page.`);
      }
      return { ...sound, bytes };
    });
  },
  /** The file of engine.write, with notes on what it could not keep. */
  write({ kind, frame, width, height, ...question }, { build, engine, progress }) {
    build({ ...question, frame });
    const { bytes, notes } = engine.write(kind, width, height, progress);
    return { blob: new Blob([bytes]), notes };
  },
  /** A file of `count` frames from `first` on. sound: two channels, or null. */
  async save({ kind, first, count, width, height, sound, ...question }, all) {
    const { build, engine, progress } = all;
    const { fps } = build({ ...question, frame: first }), video = KINDS[kind];
    let share = 0;
    const beat = () => progress(share);
    const frame = index => {
      build({ ...question, frame: first + index });
      share = (index + 1) / count;
      beat();
      const rgba = engine.pixels(width, height, undefined, Boolean(video));
      return video ? planes(rgba, width, height) : rgba;
    };
    const film = { width, height, fps, count, frame, beat };
    return new Blob(await (video ? movie(film, sound, video) : png(film)));
  },
};
