// Colours of curves and of values, in light and dark.

const LIGHT = [
    "#1f6fb4",
    "#d1622b",
    "#2a8a57",
    "#8a4fb0",
    "#b8860b",
    "#c23b6e",
    "#4f7f8f",
    "#6b6b6b",
    "#7a8b1e",
    "#7b4a2d",
];
const DARK = [
    "#6db3f2",
    "#f2955c",
    "#63c98f",
    "#c295e6",
    "#e3b74a",
    "#f27ba5",
    "#8fc1d1",
    "#b5b5b5",
    "#c3d35a",
    "#c99a77",
];

export const dark = window.matchMedia("(prefers-color-scheme: dark)");

/** Colour of the curve of that number. */
export const curve = (number) => (dark.matches ? DARK : LIGHT)[number % LIGHT.length];

/** Value of a variable of style.css. */
export const named = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Viridis (S. van der Walt, N. Smith, 2015; CC0) at nine places.
const VIRIDIS = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/** [red, green, blue], 0 to 255, of a share of the scale. */
export function ramp(share) {
    const place = Math.min(1, Math.max(0, share)) * (VIRIDIS.length - 1);
    const below = Math.min(VIRIDIS.length - 2, Math.floor(place));
    return VIRIDIS[below].map((c, i) => Math.round(c + (place - below) * (VIRIDIS[below + 1][i] - c)));
}

export const rampText = (share) => `rgb(${ramp(share).join(",")})`;

/** For Plotly: [[share, colour], ...]. */
export const rampScale = VIRIDIS.map((_, i) => [i / (VIRIDIS.length - 1), rampText(i / (VIRIDIS.length - 1))]);

/** For CSS. */
export const rampGradient = `linear-gradient(to right, ${rampScale.map(([, colour]) => colour).join(", ")})`;
