// Numbers as text: SI in the data, the units of the trade on the page.

const MINUS = '\u2212';
const THIN = '\u202f';

export function number(x, digits = 3) {
  if (typeof x !== 'number' || !Number.isFinite(x)) return '–';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e7) {
    const [m, e] = x.toExponential(Math.max(digits - 1, 0)).split('e');
    return `${m.replace('-', MINUS)}·10${power(Number(e))}`;
  }
  const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return grouped(x.toFixed(Math.min(places, 6)));
}

export function fixed(x, places) {
  return typeof x === 'number' && Number.isFinite(x) ? grouped((Math.abs(x) < 0.5 * 10 ** -places ? 0 : x).toFixed(places)) : '–';
}

/// A number beside an axis: no more digits than it has, a power of ten as that.
export function tick(x) {
  if (x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6)) {
    const e = Math.log10(x);
    return Math.abs(e - Math.round(e)) < 1e-9 ? `10${power(Math.round(e))}` : number(x, 3);
  }
  return grouped(String(Number(x.toPrecision(6))));
}

function grouped(text) {
  const [whole, part] = text.replace('-', MINUS).split('.');
  const spaced = whole.length > 4 + whole.startsWith(MINUS) ? whole.replace(/\B(?=(\d{3})+$)/g, THIN) : whole;
  return part ? `${spaced}.${part}` : spaced;
}

function power(e) {
  return String(e).replace('-', '⁻').replace(/\d/g, (d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]);
}

export const tonnes = (kg, places = 1) => fixed(kg / 1e3, places);
export const meganewtons = (n, places = 2) => fixed(n / 1e6, places);
export const megawatts = (w, places = 2) => fixed(w / 1e6, places);
export const megajoules = (j, places = 1) => fixed(j / 1e6, places);
export const percent = (x, places = 0) => (Number.isFinite(x) ? `${fixed(100 * x, places)} %` : '–');
export const seconds = (s, places = 2) => `${fixed(s, places)}${THIN}s`;

/// A p-value: how small it is below a thousandth says nothing.
export const pValue = (p) => (p < 1e-3 ? '< 0.001' : number(p, 2));

/// A time that took a machine or a person: "3 min 46 s".
export function duration(s) {
  if (!Number.isFinite(s)) return '–';
  if (s < 60) return `${number(s, 3)} s`;
  const m = Math.round(s / 60);
  if (s < 600) return `${Math.floor(s / 60)} min ${Math.floor(s % 60)} s`;
  return m < 120 ? `${m} min` : `${Math.floor(m / 60)} h ${m % 60} min`;
}
