// Colours are chosen in colours.css, for light and for dark; what draws on a canvas asks for them here.

const dark = window.matchMedia('(prefers-color-scheme: dark)');

/** The value of a custom property such as '--ink'. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function onThemeChange(change: () => void): void {
  dark.addEventListener('change', change);
}
