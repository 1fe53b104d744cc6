// Pictures of the dig with its figures, one at a time: for `dipper report --video` and `--poster`.

/// Gives picture(time, width, height, type) -> a data URL. `lines()` are the words over the picture, the time first;
/// `scale` is that of the rock's colours: {what, stops, low, high}, the ends as words; none without rock.
export function film(stage, clock, lines, scale) {
  const sheet = document.createElement('canvas');
  return (time, width, height, type) => {
    clock.set(time);
    stage.renderer.setPixelRatio(1);
    stage.resize(width, height);
    stage.draw();
    sheet.width = width;
    sheet.height = height;
    const paint = sheet.getContext('2d');
    paint.drawImage(stage.renderer.domElement, 0, 0);
    const em = height / 34;
    paint.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--ink');
    let y = 1.2 * em;
    for (const [k, text] of lines().filter(Boolean).entries()) {
      paint.font = `${k ? 400 : 600} ${k ? em : 1.8 * em}px "IBM Plex Sans", system-ui, sans-serif`;
      paint.textBaseline = 'top';
      paint.fillText(text, 1.2 * em, y);
      y += k ? 1.45 * em : 2.3 * em;
    }
    if (scale) drawScale(paint, scale, 1.2 * em, height - 1.2 * em, em);
    return sheet.toDataURL(type, 0.92);
  };
}

/// The scale's colours between its ends, its name above; x and y of the lower left corner.
function drawScale(paint, { what, stops, low, high }, x, y, em) {
  const width = 10 * em;
  const bar = paint.createLinearGradient(x, 0, x + width, 0);
  stops.forEach((colour, k) => bar.addColorStop(k / (stops.length - 1), colour));
  paint.textBaseline = 'bottom';
  const ends = [[low, x, 'left'], [high, x + width, 'right']];
  ends.forEach(([text, at, side]) => {
    paint.textAlign = side;
    paint.fillText(text, at, y);
  });
  paint.textAlign = 'left';
  paint.fillText(what, x, y - 2.2 * em);
  paint.fillStyle = bar;
  paint.fillRect(x, y - 2 * em, width, 0.7 * em);
}
