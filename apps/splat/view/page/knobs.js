// The accuracy knobs: a row a knob, a column a setting.
import { element } from './element.js';

const isNumber = values => values.every(v => /^[0-9.]+$/.test(v));
const label = { a: 'left', b: 'right' };

// `settings`: { a: {knob: value}, b: ... } of what is not at its default. `changed` is told of each change.
export function showKnobs(table, knobs, settings, two, changed) {
  const sides = two ? ['a', 'b'] : ['a'];
  const rows = knobs.map(knob => {
    const cells = sides.map(side => {
      const chosen = settings[side][knob.name] ?? knob.values[0];
      const name = `${knob.name}${two ? ', ' + label[side] : ''}`;
      const take = value => {
        if (value === knob.values[0]) delete settings[side][knob.name];
        else settings[side][knob.name] = value;
        changed();
      };
      if (isNumber(knob.values)) {
        // From cheap to exact would differ from knob to knob: left is the default.
        const shown = element('output', {}, chosen);
        const slider = element('input', {
          type: 'range', min: 0, max: knob.values.length - 1, step: 1, value: knob.values.indexOf(chosen), 'aria-label': name,
          'aria-valuetext': chosen, id: `knob-${knob.name}-${side}`
        });
        slider.addEventListener('input', () => {
          shown.textContent = knob.values[slider.value];
          slider.setAttribute('aria-valuetext', shown.textContent);
          shown.classList.toggle('changed', slider.value !== '0');
        });
        slider.addEventListener('change', () => take(knob.values[slider.value]));
        shown.classList.toggle('changed', chosen !== knob.values[0]);
        return element('td', {}, element('div', { class: 'slide' }, slider, shown));
      }
      const select = element('select', { 'aria-label': name, id: `knob-${knob.name}-${side}` },
        ...knob.values.map(v => element('option', { value: v }, v)));
      select.value = chosen;
      const mark = () => select.classList.toggle('changed', select.value !== knob.values[0]);
      select.addEventListener('change', () => { mark(); take(select.value); });
      mark();
      return element('td', {}, select);
    });
    return element('tr', {}, element('th', { scope: 'row' }, knob.name), ...cells);
  });
  if (two) rows.unshift(element('tr', {}, element('th', {}, ''), element('th', { scope: 'col' }, 'left'), element('th', { scope: 'col' }, 'right')));
  table.tBodies[0].replaceChildren(...rows);
}

// As the server names it: "default", "exp=poly3,tile=32".
export const settingName = chosen =>
  Object.entries(chosen).map(([name, value]) => `${name}=${value}`).join(',') || 'default';

// The other way round; of values that there are.
export const chosenBy = (name = '', knobs = []) => Object.fromEntries(name.split(',').map(part => part.split('='))
  .filter(([of, value]) => knobs.some(k => k.name === of && k.values.indexOf(value) > 0)));
