// Hands on the picture: pointer, wheel and keys move an eye.

const TURN = 0.006;   // radians a pixel of drag
const SPEED = 0.9;    // of the distance a second, with a key held
const SPIN = 1.2;     // radians a second, with an arrow held
const MOVES = { w: [0, 0, 1], s: [0, 0, -1], a: [-1, 0, 0], d: [1, 0, 0], q: [0, 1, 0], e: [0, -1, 0] };
const TURNS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const NEAR = { '+': 1, '=': 1, '-': -1 };
const held = new Set();

const keyOf = event => event.key.length === 1 ? event.key.toLowerCase() : event.key;
const isMove = key => key in MOVES || key in TURNS || key in NEAR;
const isTyping = event => event.target.closest?.('select, input, button, summary, textarea') !== null;

// `hands`: eye() gives the eye, orbits() whether it turns about what it looks at, moved() is told of every step, clicked(x, y)
// and clickedTwice(x, y) of clicks by shares of the picture, key(k) of other keys; it returns whether it took the key. While
// paints() is true, one finger or the left button paints: painted(x, y, begins) is told of each place, and paintedAll(event) at last.
export function takeKeys(hands) {
  let last = 0;
  const act = (key, seconds) => {
    const eye = hands.eye();
    if (key in MOVES) eye.move(...MOVES[key].map(v => v * SPEED * seconds));
    else if (key in TURNS) eye.turn(...TURNS[key].map(v => v * SPIN * seconds), hands.orbits());
    else eye.near(Math.exp(-NEAR[key] * SPEED * seconds));
  };
  const step = now => {
    const seconds = Math.min((now - last) / 1000, 0.1);
    last = now;
    if (held.size === 0) return;
    for (const key of held) act(key, seconds);
    hands.moved();
    requestAnimationFrame(step);
  };
  document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.altKey || event.metaKey || isTyping(event)) return;
    const key = keyOf(event);
    if (isMove(key)) {
      event.preventDefault();
      if (held.has(key)) return;
      if (held.size === 0) {
        last = performance.now();
        requestAnimationFrame(step);
      }
      held.add(key);
      // However short the tap.
      act(key, 0.05);
      hands.moved();
    } else if (!event.repeat && hands.key(key)) event.preventDefault();
  });
  document.addEventListener('keyup', event => held.delete(keyOf(event)));
  window.addEventListener('blur', () => held.clear());
}

export const keysHeld = () => held.size > 0;

const TWICE = 300; // ms between two clicks that are one double click

export function takePointer(canvas, hands) {
  const pointers = new Map();
  let travelled = 0, once = null, painting = false;
  const shareOf = event => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 0) travelled = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    // A second finger moves, as it does otherwise.
    painting = pointers.size === 1 && event.button === 0 && Boolean(hands.paints?.());
    if (painting) hands.painted(...shareOf(event), true);
  });
  canvas.addEventListener('pointermove', event => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    if (painting) {
      hands.painted(...shareOf(event), false);
      return;
    }
    const wide = pointers.size === 2 ? spread() : 0;
    const dx = event.clientX - before.x, dy = event.clientY - before.y;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travelled += Math.abs(dx) + Math.abs(dy);
    if (travelled < 4) return;
    const eye = hands.eye();
    const share = 1 / canvas.clientWidth;
    if (pointers.size === 2) {
      if (spread() > 0) eye.near(wide / spread());
      eye.move(-dx * share / 2, -dy * share / 2, 0);
    } else if (event.shiftKey || event.buttons & 6) eye.move(-dx * share, -dy * share, 0);
    else eye.turn(dx * TURN, dy * TURN, hands.orbits());
    hands.moved();
  });
  const end = event => {
    if (!pointers.delete(event.pointerId)) return;
    if (painting) {
      painting = false;
      hands.paintedAll(event);
      return;
    }
    if (event.type === 'pointercancel' || travelled >= 4 || pointers.size) return;
    clearTimeout(once);
    if (once !== null) hands.clickedTwice?.(...shareOf(event));
    once = once !== null ? null : setTimeout(() => {
      once = null;
      hands.clicked?.(...shareOf(event));
    }, TWICE);
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('contextmenu', event => event.preventDefault());
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    hands.eye().near(Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 0.002));
    hands.moved();
  }, { passive: false });
}
