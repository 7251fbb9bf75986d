// The address: the token behind its #, which browsers send to nobody, then the page's state: #TOKEN&layer=error&two=on.

const plain = text => encodeURIComponent(text).replace(/%(2C|3A|3D|2F)/g, decodeURIComponent);

// The token, and an object of texts by name.
export function readAddress(hash = location.hash) {
  const [token, ...parts] = hash.slice(1).split('&');
  const state = {};
  for (const part of parts) {
    const at = part.indexOf('=');
    try {
      if (at > 0) state[part.slice(0, at)] = decodeURIComponent(part.slice(at + 1));
    } catch {
      // A part that is cut off is as if absent.
    }
  }
  return { token, state };
}

// Without an entry in the browser's history for each.
export function writeAddress(token, state) {
  const hash = ['#' + token, ...Object.entries(state).map(([name, text]) => `${name}=${plain(text)}`)].join('&');
  if (hash !== location.hash) history.replaceState(null, '', hash);
}
