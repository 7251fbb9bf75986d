// Files for the user's folder of downloads.
import { element } from './element.js';

export function saveBlob(blob, name) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// A name of a file with these parts; those that are empty are left out.
export const fileName = (...parts) => parts.filter(part => part).map(part => part.replace(/[^\w.=,-]+/g, '_')).join('-');

export const savePng = (canvas, name) => canvas.toBlob(blob => saveBlob(blob, `${name}.png`));
