// Pictures of the dig with its figures, one at a time: for `dipper report --video` and `--poster`.

/// Gives picture(time, width, height, type) -> a data URL. `lines()` are the words over the picture, the time first.
export function film(stage, clock, lines) {
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
    return sheet.toDataURL(type, 0.92);
  };
}
