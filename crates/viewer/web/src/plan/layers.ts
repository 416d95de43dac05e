/** What of a drawing can be switched off: the class that hides it, its key, its word, and what there must be for it. */
const LAYERS = [
  ['comb', 'C', 'layer.comb', '.comb'],
  ['dots', 'D', 'points', '.dots'],
  ['joins', 'V', 'joins', '.join'],
  ['nominal', 'N', 'reference', '.nominal'],
  ['off', 'W', 'deviation', '.whisker'],
] as const

/** Those of the drawings of this page. */
export const layers = () => LAYERS.filter(([, , , part]) => document.querySelector(`#drawing ${part}`))
