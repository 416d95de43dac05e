/** What of a drawing can be switched off: the class that hides it, its key and its word. */
export const LAYERS = [
  ['comb', 'C', 'layer.comb'],
  ['dots', 'D', 'points'],
  ['joins', 'V', 'joins'],
] as const
