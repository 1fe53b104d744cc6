export function payload(model) { return null; }
