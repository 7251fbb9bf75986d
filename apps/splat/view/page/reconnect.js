// What a page does while its server is away. Each run of the server has another token, which only its printed address has.
import { readAddress, writeAddress } from './address.js';
import { token } from './api.js';

const pages = new BroadcastChannel('splat');
const wait = ms => new Promise(done => setTimeout(done, ms));
let away = false, newest = null;

// Nothing secret is sent: another program may listen at this port now.
async function isBack() {
  try {
    return (await fetch('style.css', { cache: 'no-store' })).ok;
  } catch {
    return false;
  }
}

// The page starts again with the state of its address.
function goOn(newToken) {
  writeAddress(newToken, readAddress().state);
  location.reload();
}

// `say` is told what is going on, and shows it.
export async function waitForServer(say) {
  if (away) return;
  away = true;
  document.documentElement.dataset.away = 'yes';
  say('splat does not answer. This page goes on when it is started again with the same --port and scene.');
  while (!await isBack()) await wait(1000);
  // Another page has it already.
  if (newest) goOn(newest);
  say('splat was started again, and has a new address: open it in this tab or in another, then this page goes on.');
}

// To be called once the server has accepted the token: pages of earlier runs go on with it.
export function announce() {
  pages.postMessage(token);
}

// A page that nobody looks at asks its server nothing, and learns later that it was restarted.
pages.onmessage = ({ data }) => {
  if (data === token) return;
  newest = data;
  if (away) goOn(data);
};
// An address that is entered into this page's tab has its state, or none and takes this page's.
let shown = readAddress().state;
export const remember = state => { shown = state; };
window.addEventListener('hashchange', () => {
  const { token: entered, state } = readAddress();
  writeAddress(entered, Object.keys(state).length || entered === token ? state : shown);
  location.reload();
});
