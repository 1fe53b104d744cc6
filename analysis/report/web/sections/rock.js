export function rock(model) { return null; }
