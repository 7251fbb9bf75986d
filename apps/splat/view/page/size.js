// How large a picture is on the page.

// CSS pixels of the tallest picture that the window shows below the tools; at least a few rows in a low window.
function mostHeight(views) {
  if (document.fullscreenElement) return window.innerHeight;
  return Math.max(180, Math.floor(window.innerHeight - (views.getBoundingClientRect().top + window.scrollY) - 40));
}

// Width and height in pixels of each of `count` pictures side by side: `fixed`, or by the window and at most `most` each.
export function pictureSize(views, fixed, most, count) {
  const style = getComputedStyle(views), columns = style.gridTemplateColumns.split(' ').length;
  const width = Math.floor((views.clientWidth - (columns - 1) * parseFloat(style.columnGap)) / columns);
  // One below the other, both are seen.
  const height = Math.floor(mostHeight(views) / (columns < count ? count : 1));
  const size = fixed ?? { width: Math.max(16, Math.min(most, width)), height: Math.max(16, Math.min(most, height)) };
  views.parentElement.style.setProperty('--picture', `min(100%, ${height * size.width / size.height}px)`);
  return size;
}
