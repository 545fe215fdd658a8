// Requests of the page to the server of celspan watch, with the token of this run.
//
// The address that celspan prints has the token. The browser keeps it for this address and this
// port alone, and the page sends it in a header: a cookie would go to all servers of this machine.
const NAME = "celspan-token";

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
