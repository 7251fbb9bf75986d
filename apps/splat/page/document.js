// What a page's scripts use of a browser's document, for splat-figures, which runs them without one: elements without a place or a look.
// There is no `window`, by which a script can tell.

const UNCLOSED = ['meta', 'input', 'img', 'br', 'link'];

class PageElement {
  constructor(name) {
    Object.assign(this, { tagName: name.toUpperCase(), childNodes: [], parentElement: null, attributes: {}, style: {}, dataset: {}, hidden: false, handlers: [] });
  }

  setAttribute(key, value) {
    this.attributes[key] = String(value);
    if (key === 'hidden') this.hidden = true;
  }
  getAttribute(key) { return this.attributes[key] ?? null; }
  get id() { return this.attributes.id ?? ''; }
  get classList() {
    const words = new Set((this.attributes.class ?? '').split(' ').filter(w => w)), keep = () => { this.attributes.class = [...words].join(' '); };
    return {
      contains: word => words.has(word),
      add: (...more) => { more.forEach(w => words.add(w)); keep(); },
      toggle: (word, isOn = !words.has(word)) => { words[isOn ? 'add' : 'delete'](word); keep(); },
    };
  }
  set className(words) { this.attributes.class = words; }

  get children() { return this.childNodes.filter(c => c instanceof PageElement); }
  #leave() {
    if (!this.parentElement) return;
    this.parentElement.childNodes = this.parentElement.childNodes.filter(c => c !== this);
    this.parentElement = null;
  }
  #adopted(nodes) {
    return nodes.map(node => {
      if (!(node instanceof PageElement)) return String(node);
      node.#leave();
      node.parentElement = this;
      return node;
    });
  }
  append(...nodes) {
    const all = this.#adopted(nodes); // which may have been here
    this.childNodes.push(...all);
  }
  replaceChildren(...nodes) {
    this.children.forEach(c => c.#leave());
    this.childNodes = this.#adopted(nodes);
  }
  after(...nodes) {
    const above = this.parentElement, all = above.#adopted(nodes);
    above.childNodes.splice(above.childNodes.indexOf(this) + 1, 0, ...all);
  }
  replaceWith(...nodes) {
    this.after(...nodes);
    this.#leave();
  }
  get nextElementSibling() {
    const beside = this.parentElement.children;
    return beside[beside.indexOf(this) + 1] ?? null;
  }
  get textContent() { return this.childNodes.map(c => (c instanceof PageElement ? c.textContent : c)).join(''); }
  set textContent(text) { this.replaceChildren(text); }

  // Selectors of names, .classes and #ids, below each other, and lists of them.
  #matches(selector) {
    const parts = selector.trim().split(/\s+/), own = parts.pop();
    const fits = [...own.matchAll(/([#.]?)([\w-]+)/g)].every(([, mark, word]) =>
      (mark === '#' ? this.id === word : mark === '.' ? this.classList.contains(word) : this.tagName === word.toUpperCase()));
    return fits && (!parts.length || Boolean(this.parentElement?.closest(parts.join(' '))));
  }
  closest(selector) { return selector.split(',').some(s => this.#matches(s)) ? this : this.parentElement?.closest(selector) ?? null; }
  querySelectorAll(selector) {
    return this.children.flatMap(c => [...(selector.split(',').some(s => c.#matches(s)) ? [c] : []), ...c.querySelectorAll(selector)]);
  }
  querySelector(selector) { return this.querySelectorAll(selector)[0] ?? null; }
  get tHead() { return this.querySelector('thead'); }
  get tBodies() { return this.querySelectorAll('tbody'); }
  get rows() { return this.querySelectorAll('tr'); }
  get options() { return this.querySelectorAll('option'); }
  get value() { return this.chosen ?? this.attributes.value ?? this.options[0]?.value ?? ''; }
  set value(value) { this.chosen = String(value); }

  addEventListener(kind, handler) { this.handlers.push([kind, handler]); }
  dispatchEvent(event) { this.handlers.filter(([kind]) => kind === event.type).forEach(([, handler]) => handler(event)); }
}

class Event {
  constructor(type) { this.type = type; }
}

const matchMedia = () => ({ matches: false, addEventListener() {} });
const addEventListener = () => {};
const location = { hash: '' };
const document = new PageElement('html');
document.documentElement = document;
document.createElement = name => new PageElement(name);
document.getElementById = id => document.querySelector(`#${id}`);

// Fills the document from the page's text; gives its scripts.
function openDocument(text) {
  const plain = t => t.replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&quot;', '"').replaceAll('&amp;', '&');
  let at = document;
  // Scripts and styles are text up to their end.
  for (const [, raw, rawAttributes, rawText, end, name, attributes, content] of
    text.matchAll(/<(script|style)\b([^>]*)>([\s\S]*?)<\/\1>|<(\/?)([a-zA-Z][\w-]*)([^>]*)>|([^<]+)/g)) {
    if (content !== undefined) at.append(plain(content));
    else if (end) at = at.parentElement ?? document;
    else if ((raw ?? name).toLowerCase() !== 'html') {
      const e = document.createElement(raw ?? name);
      for (const [, key, value] of (rawAttributes ?? attributes).matchAll(/([\w-]+)(?:="([^"]*)")?/g)) e.setAttribute(key, plain(value ?? ''));
      at.append(e);
      if (raw) e.append(rawText);
      else if (!UNCLOSED.includes(name)) at = e;
    }
  }
  document.body = document.querySelector('body');
  return document.querySelectorAll('script').filter(s => !s.getAttribute('type')).map(s => s.textContent);
}
