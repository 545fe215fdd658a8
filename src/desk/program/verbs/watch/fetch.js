// Requests of the page to the server of celspan watch, with the token of this run.
//
// The address that celspan prints has the token. The browser keeps it for this address and this
// port alone, and the page sends it in a header: a cookie would go to all servers of this machine.
const NAME = "celspan-token", BUSY = 503;
const PATIENCE = 5; // seconds

let token = new URLSearchParams(location.search).get("token");
try {
  if (token) localStorage.setItem(NAME, token);
  else token = localStorage.getItem(NAME);
} catch {
  // This browser cannot store the token: the page works until it is loaded again.
}

/** fetch, with the token. Modules of the page import it in place of the browser's. */
export const fetch = (address, more = {}) =>
  window.fetch(address, { ...more, headers: { "Celspan-Token": token || "" } });

/** What the server says first. It is asked for while other modules are on their way, because the
 * first picture waits for it. */
export const firstState = fetch("/state.json?since=0").catch(() => null);

export const post = (path, value) => fetch(path, { method: "POST", body: JSON.stringify(value) });

export const pause = seconds => new Promise(done => setTimeout(done, seconds * 1000));

let noteFirst;
const first = new Promise(done => { noteFirst = done; });

/** Called when a picture is seen, or cannot be: what lies beside it may be asked for now. */
export const noteSeen = () => noteFirst();

/** The JSON of an address; null: it was refused. Renderers that are busy are asked again as long as
 * it is wanted. Nothing is asked for before the first picture, which would have to wait for it,
 * unless that takes long. */
export async function read(address, isWanted = () => true) {
  await Promise.race([first, pause(PATIENCE)]);
  for (;;) {
    const answer = await fetch(address).catch(() => null);
    if (answer?.ok) return answer.json();
    if (answer?.status !== BUSY || !isWanted()) return null;
    await pause(0.3);
  }
}

/** A function that runs `act` with a value: while it runs, only the newest value is kept. `act` is
 * given the value, and a function that says whether there is no newer one. */
export function newest(act) {
  let next = null, isRunning = false;
  return async value => {
    next = { value };
    if (isRunning) return;
    isRunning = true;
    try {
      for (let one = next; one; one = next) {
        next = null;
        await act(one.value, () => !next);
      }
    } finally {
      isRunning = false;
    }
  };
}
