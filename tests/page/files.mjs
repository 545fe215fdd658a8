// The files of scripts that the engine of web pages runs in node.
import fs from "fs";

const isFile = (name) => fs.statSync(name, { throwIfNoEntry: false })?.isFile();

/** The content of a path that was looked for: from more.json, from the current folder, from the
 * disk, or from the folder that a question allows; undefined: there is none. */
const contentOf = (path, more, allowed) => {
  const own = path.replace(/^[/]+/, "");
  const found = [own, path, `${allowed}/${own}`].find(isFile);
  return more[own] ?? (found && fs.readFileSync(found));
};

/** What work() returns, which is done again for as long as there are files that it lacked. */
export const withFiles = (engine, more, work, allowed = ".") => {
  for (;;) {
    let given = false, error;
    try { return work(); } catch (caught) { error = caught; }
    for (const path of engine.missing()) {
      const content = contentOf(path, more, allowed);
      if (content !== undefined) engine.file(path, content);
      given ||= content !== undefined;
    }
    if (!given) throw error;
  }
};
