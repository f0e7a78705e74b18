// Units in which people read numbers, and how many digits.

const READ_AS = {
    Pa: [1e-6, "MPa"],
    N: [1e-3, "kN"],
    "N m": [1e-3, "kN m"],
    m: [1e3, "mm"],
    m2: [1e6, "mm²"],
    s: [1e3, "ms"],
    "m/s2": [1, "m/s²"],
    1: [1, ""],
};

/** {factor, label} of an SI unit: value in SI times factor is in `label`. */
export function readAs(unit) {
    const [factor, label] = READ_AS[unit] ?? [1, unit];
    return { factor, label };
}

/** "normal force, kN" */
export const withUnit = (text, label) => (label ? `${text}, ${label}` : text);

/** A number with so many digits that count, without an exponent where that stays short. */
export function digits(value, count = 4) {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size >= 1e6 || size < 1e-4) return value.toExponential(count - 1);
    return Number(value.toPrecision(count)).toString();
}

/** An SI value with its unit, as people read it. */
export function quantity(value, unit, count = 4) {
    const { factor, label } = readAs(unit);
    return `${digits(value * factor, count)}${label ? ` ${label}` : ""}`;
}

/** "normal_force" as words. */
export const words = (name) => name.replaceAll("_", " ");
