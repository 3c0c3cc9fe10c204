// Colours that stay apart for readers with any kind of colour vision, on light and on dark ground.

// Okabe and Ito's eight, with black and yellow shifted for each ground.
const on_light = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b08900', '#3a9bd9', '#7b3294', '#555555'];
const on_dark = ['#56b4e9', '#ff8c42', '#2fc79a', '#e79ac4', '#f0e442', '#8fd3ff', '#c89bea', '#c4c4c4'];
const dashes = [[], [7, 4], [2, 3], [9, 3, 2, 3]];

export function is_dark() {
  const theme = document.documentElement.dataset.theme;
  return theme === 'dark' || (theme === 'auto' && matchMedia('(prefers-color-scheme: dark)').matches);
}
export function series_colour(i) { return (is_dark() ? on_dark : on_light)[i % on_light.length]; }
/** Beyond eight series a dash tells them apart. */
export function series_dash(i) { return dashes[Math.floor(i / on_light.length) % dashes.length]; }
export function themed(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

// Plasma (van der Walt and Smith, 2015), whose lightness rises evenly: also readable in grey. Light ground takes its dark part,
// dark ground its light part.
const plasma = [[13, 8, 135], [75, 3, 161], [125, 3, 168], [168, 34, 150], [203, 70, 121], [229, 107, 93], [248, 148, 65], [253, 195, 40], [240, 249, 33]];
const part = () => is_dark() ? [0.3, 1] : [0, 0.8];

/** [r, g, b] from 0 to 255 of a share from 0 to 1. */
export function ramp(share) {
  const [low, high] = part();
  const at = (low + (high - low) * Math.min(1, Math.max(0, share))) * (plasma.length - 1);
  const i = Math.min(plasma.length - 2, Math.floor(at)), rest = at - i;
  return plasma[i].map((value, c) => Math.round(value + rest * (plasma[i + 1][c] - value)));
}
export function css_of([r, g, b]) { return `rgb(${r}, ${g}, ${b})`; }
/** Black or white, whichever reads better on the colour (WCAG's relative luminance). */
export function ink_on(rgb) {
  const [r, g, b] = rgb.map((value) => (value /= 255, value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000' : '#fff';
}
